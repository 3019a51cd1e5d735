// log.h: lines for people, on stderr (standard_streams.h). Secrets never go here.
// Threads: any thread. A program calls nameLog once, first.
#pragma once

#include <fmt/core.h>

#include <string_view>

namespace ninefold {

// Puts `name` (e.g. "master", "client 2") in front of each line of this process.
void nameLog(std::string_view name);

void logLine(std::string_view text);
void warnLine(std::string_view text);

template <typename... Args>
void log(fmt::format_string<Args...> format, Args&&... args) {
  logLine(fmt::format(format, std::forward<Args>(args)...));
}

template <typename... Args>
void warn(fmt::format_string<Args...> format, Args&&... args) {
  warnLine(fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace ninefold
