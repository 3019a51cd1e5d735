// numbered_name.h: names of files in a series: out.####.png.
// Threads: pure functions.   Errors: none.
#pragma once

#include <string>

namespace ninefold {

// Whether the file's name, not its folder's, has a #.
bool isNumbered(const std::string& output);
// out.####.png with a number in place of the last run of #: out.0012.png. The name must have one.
std::string numbered(const std::string& output, int number);

}  // namespace ninefold
