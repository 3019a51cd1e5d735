// command_line.h: what the command lines of all programs share. A flag counts before its
// environment variable (NINEFOLD_*), that before the default. Wrong usage is one line and exit
// status 2.
//
// Threads: pure, but for processVariable.   Errors: UsageError.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/base/error.h"

namespace ninefold {

// Wrong usage of a program. main catches it before Error, prints it, and exits with status 2.
class UsageError : public Error {
 public:
  using Error::Error;
};

template <typename... Args>
[[noreturn]] void failUsage(fmt::format_string<Args...> format, Args&&... args) {
  throw UsageError(fmt::format(format, std::forward<Args>(args)...));
}

// Looks up an environment variable, so that tests need no real environment.
using Variable = std::function<std::optional<std::string>(const std::string& name)>;
std::optional<std::string> processVariable(const std::string& name);

// The variable that stands for a flag: "key-file" -> "NINEFOLD_KEY_FILE".
std::string variableOfFlag(std::string_view flag);

// "640x480" -> {640, 480}: two whole numbers in [low, high].
std::pair<int, int> parsePair(std::string_view flag, std::string_view text, int low, int high);

// "1.5,2,0.25" -> those numbers; at least one, all finite.
std::vector<double> parseNumbers(std::string_view flag, std::string_view text, char between = ',');

// A whole number in [low, high].
uint64_t parseWhole(std::string_view flag, std::string_view text, uint64_t low, uint64_t high);

// `value`, which must be in [low, high]; NaN is not.
template <typename T>
T checkRange(std::string_view flag, T value, T low, T high) {
  if (value >= low && value <= high) return value;
  failUsage("--{} {}: must be {} to {}", flag, value, low, high);
}

}  // namespace ninefold
