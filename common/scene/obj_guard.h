// obj_guard.h: looks over an OBJ file before the parser sees it. The parser reads what is no
// number as 0 and what is out of range as anything; here each such line is an error with its
// number.
//
// Checked: numbers of v, vn, vt are finite; corners of faces name vertices that exist (counted
// from the end if negative); polygons have 3 to kMaxCorners corners; the triangles stay within
// reader.h's limit.
// Errors: throws Error, naming the line.
// Threads: pure.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ninefold {

inline constexpr size_t kMaxCorners = 1024;

// Material libraries that the file names, each as the rest of its line.
std::vector<std::string> checkObj(std::string_view text);

}  // namespace ninefold
