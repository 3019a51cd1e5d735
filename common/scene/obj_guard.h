// obj_guard.h: looks over an OBJ file before the parser sees it. The parser reads what is no
// number as 0 and what is out of range as anything; here each such line is an error with its
// number.
//
// Checked: numbers of v, vn, vt are finite; corners of faces name vertices that exist (counted
// from the end if negative); polygons have 3 to kMaxCorners corners; the triangles stay within
// reader.h's limit. Positions are taken here, in double precision: the parser's are single, and a
// scene in map coordinates (half a million metres and some) would stand on a grid of 3 cm.
// Errors: throws Error, naming the line.
// Threads: pure.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/math/vec.h"

namespace ninefold {

inline constexpr size_t kMaxCorners = 1024;

struct ObjOutline {
  std::vector<std::string> libraries;  // material libraries, each as the rest of its line
  std::vector<DVec3> positions;        // of all lines v
};

ObjOutline checkObj(std::string_view text);

}  // namespace ninefold
