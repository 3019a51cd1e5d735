// words.h: the command line of a tool that takes the flags of ninefold-master beside its own.
// Errors: UsageError in one line.   Threads: main.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/command_line.h"
#include "master/options/options.h"

namespace ninefold {

// The words of a command line, without those that are this tool's own.
class Words {
 public:
  Words(int argc, char** argv) : words_(argv, argv + argc) {}

  bool has(std::string_view flag) const {
    return std::any_of(words_.begin() + 1, words_.end(), [&](const std::string& w) {
      return w == flag || w.starts_with(std::string(flag) + "=");
    });
  }
  void addIfMissing(const std::string& flag, const std::string& value) {
    if (!has("--" + flag)) words_.push_back("--" + flag + "=" + value);
  }
  void add(const std::string& word) { words_.push_back(word); }
  // Takes --flag VALUE or --flag=VALUE out.
  std::optional<std::string> take(const std::string& flag) {
    const std::string name = "--" + flag;
    for (auto at = words_.begin() + 1; at != words_.end(); ++at) {
      if (at->starts_with(name + "=")) {
        const std::string value = at->substr(name.size() + 1);
        return words_.erase(at), value;
      }
      if (*at != name) continue;
      if (at + 1 == words_.end()) failUsage("{} needs a value", name);
      const std::string value = *(at + 1);
      return words_.erase(at, at + 2), value;
    }
    return std::nullopt;
  }
  int takeWhole(const std::string& flag, int usual, int low, int high) {
    const auto text = take(flag);
    if (!text) return usual;
    return static_cast<int>(
        parseWhole(flag, *text, static_cast<uint64_t>(low), static_cast<uint64_t>(high)));
  }
  Options options() const {
    std::vector<const char*> all;
    for (const std::string& word : words_) all.push_back(word.c_str());
    return parseOptions(static_cast<int>(all.size()), all.data(), processVariable, 1);
  }

 private:
  std::vector<std::string> words_;
};

}  // namespace ninefold
