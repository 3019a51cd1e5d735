// polygon.h: simple polygons in space to triangles, by cutting off ears in the polygon's mean
// plane. A polygon that crosses itself, or whose ears are not found within 64 tries a corner, ends
// as a fan: all of its corners are used, and the work is bounded.
//
// Source:  Meisters, "Polygons Have Ears", 1975.
// Threads: pure.   Errors: none.
#pragma once

#include <span>
#include <vector>

#include "common/math/vec.h"

namespace ninefold {

// n corners give n - 2 triangles of indices into `corners`, wound as the polygon. n >= 3.
std::vector<Triangle> triangulate(std::span<const Vec3> corners);

}  // namespace ninefold
