// unread_keys.h: what a scene file says and nobody reads, for one warning a file.
// Owner: value type.   Threads: one.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "common/base/log.h"

namespace ninefold {

class UnreadKeys {
 public:
  void add(std::string_view key, uint64_t line) {
    if (firstLines_.size() >= kMost) return;
    std::string shown(key.substr(0, 40));
    for (char& c : shown)
      if (static_cast<unsigned char>(c) < ' ') c = '?';
    firstLines_.try_emplace(std::move(shown), line);
  }

  // `file`: as the warning shall name it.
  void report(const std::string& file) const {
    if (firstLines_.empty()) return;
    std::string list;
    for (const auto& [key, line] : firstLines_)
      list += fmt::format("{}{} (line {})", list.empty() ? "" : ", ", key, line);
    warn("{}: not modelled and left out: {}", file, list);
  }

 private:
  static constexpr size_t kMost = 40;  // a damaged file has any number
  std::map<std::string, uint64_t> firstLines_;
};

}  // namespace ninefold
