// place.h: a point of a surface and the side of it that is meant. Cosines are signed, normals are
// geometric: the back of a wall is another place.
// Threads: plain data.
#pragma once

#include "common/math/vec.h"

namespace ninefold {

struct Place {
  Vec3 position{0};
  Vec3 normal{0};   // unit, geometric, of the side that is meant
  float error = 0;  // of position, see SurfacePoint
};

}  // namespace ninefold
