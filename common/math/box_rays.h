// box_rays.h: whether a ray meets a box.
// Threads: pure function.   Errors: none.   Proved: tests/gi/straight_light_test.cpp.
#pragma once

#include <algorithm>

#include "common/math/bounds.h"

namespace ninefold {

// Whether origin + t direction lies in the box for some t in [0, far]. A ray in the plane of a face
// may count or not.
inline bool meetsBox(const Bounds& box, Vec3 origin, Vec3 direction, float far) {
  const Vec3 inverse = 1.0f / direction;
  float near = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const float t0 = (box.low[axis] - origin[axis]) * inverse[axis];
    const float t1 = (box.high[axis] - origin[axis]) * inverse[axis];
    near = std::max(near, std::min(t0, t1)), far = std::min(far, std::max(t0, t1));
  }
  return near <= far;
}

}  // namespace ninefold
