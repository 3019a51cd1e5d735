// program.h: what every main does around its program: streams, the exit status, the last line.
#pragma once

#include <functional>
#include <string_view>

namespace ninefold {

// Returns the status of `run`; 2 after a UsageError, 1 after any other exception. Each exception is
// told in one line.
int runProgram(std::string_view name, const std::function<int()>& run);

}  // namespace ninefold
