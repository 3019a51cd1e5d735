// program.h: what every main does around its program: streams, the exit status, the last line.
#pragma once

#include <functional>
#include <string_view>

namespace ninefold {

// The status of `run`; 2 after a UsageError and 1 after any other exception, each told in one line.
int runProgram(std::string_view name, const std::function<int()>& run);

}  // namespace ninefold
