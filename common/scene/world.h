// world.h: from an instance's coordinates to the scene's. All that need a vertex in the scene take
// it from here, so that tracer, emitters and bounds agree to the last bit.
// Threads: pure functions.
#pragma once

#include "common/scene/scene.h"

namespace ninefold {

inline Vec3 worldPoint(const DMat4& toWorld, Vec3 p) {
  return Vec3(DVec3(toWorld * DVec4(DVec3(p), 1.0)));
}

// True if the instance mirrors. Its triangles then turn the other way round: their front is on the
// other side of cross(b - a, c - a).
inline bool mirrors(const DMat4& toWorld) { return glm::determinant(DMat3(toWorld)) < 0; }

// True if a matrix is finite, affine and clearly invertible: what an instance may have.
inline bool isPlacement(const DMat4& m) {
  double largest = 0;
  for (int column = 0; column < 4; ++column) {
    if (m[column][3] != (column == 3 ? 1.0 : 0.0)) return false;
    for (int row = 0; row < 3; ++row)
      if (!std::isfinite(m[column][row])) return false;
    if (column < 3) largest = std::max(largest, glm::length(DVec3(m[column])));
  }
  return std::abs(glm::determinant(DMat3(m))) > 1e-18 * largest * largest * largest;
}

// Box of all instances.
Bounds boundsOf(const Scene& scene);

}  // namespace ninefold
