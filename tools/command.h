// command.h: what the command lines of all tools have in common: words and flags, --help,
// --version, the exit status.
// Errors: UsageError in one line.   Threads: main.
#pragma once

#include <boost/program_options.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "common/base/command_line.h"
#include "common/base/program.h"
#include "common/base/release.h"
#include "common/base/standard_streams.h"

namespace ninefold {

struct Command {
  std::string name;   // "ninefold-compare"
  std::string usage;  // what follows the name: "IMAGE REFERENCE [--json]"
  std::string about;  // sentences, each with its line end
  boost::program_options::options_description flags{"Options"};
  std::vector<std::pair<const char*, std::string*>> words = {};  // all must be given, in this order
};

inline std::string helpOf(const Command& command,
                          const boost::program_options::options_description& flags) {
  std::ostringstream text;
  text << "Usage: " << command.name << " " << command.usage << "\n\n"
       << command.about << "\n"
       << flags << "\nExit status: 0 done, 1 a failure (one line on stderr), 2 wrong usage.\n";
  return text.str();
}

// False: help or version was asked for and is given.
inline bool parseCommandLine(int argc, const char* const* argv, const Command& command) {
  namespace po = boost::program_options;
  po::options_description visible(command.flags), all;
  visible.add_options()("help,h", "print this and end")("version", "print the release and end");
  all.add(visible);
  po::positional_options_description places;
  for (const auto& [name, value] : command.words) {
    all.add_options()(name, po::value(value));
    places.add(name, 1);
  }
  try {
    po::variables_map values;
    po::store(po::command_line_parser(argc, argv).options(all).positional(places).run(), values);
    po::notify(values);
    if (values.contains("help")) return writeOutput(helpOf(command, visible)), false;
    if (values.contains("version")) return writeOutput(versionText(command.name)), false;
    for (const auto& [name, value] : command.words)
      if (value->empty()) failUsage("{} is missing", name);
  } catch (const po::error& error) {
    failUsage("{}; see {} --help", error.what(), command.name);
  } catch (const UsageError& error) {
    failUsage("{}; see {} --help", error.what(), command.name);
  }
  return true;
}

}  // namespace ninefold
