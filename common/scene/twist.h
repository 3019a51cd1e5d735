// twist.h: a mesh turned about the vertical, the more the higher: a deformation that is no motion.
//
//   x' = R(phi(x)) x           phi = angle (y - low)/(high - low), clamped to [0, angle]
//   n' ~ R(phi) (n - k up (a n))   k = dphi/dy [rad/m], a = up x (x - centre): the inverse
//                                  transpose of the derivative of x'
//
// in the scene's coordinates, for the instance whose place is given. Volumes stay.
//
// Source:  Barr, "Global and Local Deformations of Solid Primitives", 1984.
// Proved:  tests/scene/shape_edit_test.cpp.   Threads: pure function.   Errors: none.
#pragma once

#include "common/scene/shape_edit.h"

namespace ninefold {

struct Twist {
  DVec3 centre{0};           // on the axis
  double low = 0, high = 0;  // [m]; high > low
  double angle = 0;          // at the top [rad]
};

std::vector<ShapeEdit> twisted(const Scene& scene, uint32_t mesh, const DMat4& toWorld,
                               const Twist& twist);

}  // namespace ninefold
