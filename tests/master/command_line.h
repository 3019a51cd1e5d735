// command_line.h: a command line of ninefold-master, read or refused.
#pragma once

#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "master/options/options.h"

namespace ninefold::testing {

using Variables = std::map<std::string, std::string>;

// Words as a shell would hand them over; without an output there would be nothing to do.
inline Options parse(const std::string& line, const Variables& variables = {}, bool output = true) {
  std::vector<std::string> words{"ninefold-master"};
  std::istringstream in(line);
  for (std::string word; in >> word;) words.push_back(word);
  if (output) words.insert(words.end(), {"--output", "out.exr"});
  std::vector<const char*> argv;
  for (const std::string& word : words) argv.push_back(word.c_str());
  const auto variable = [&](const std::string& name) {
    const auto found = variables.find(name);
    return found == variables.end() ? std::nullopt : std::optional(found->second);
  };
  return parseOptions(static_cast<int>(argv.size()), argv.data(), variable, 6);
}

// The one line that a wrong command line ends in; "" if it was right.
inline std::string complaint(const std::string& line, const Variables& variables = {},
                             bool output = true) {
  try {
    parse(line, variables, output);
    return "";
  } catch (const UsageError& error) {
    return error.what();
  }
}

}  // namespace ninefold::testing
