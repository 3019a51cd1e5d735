// world.h: from an instance's coordinates to the scene's. Everybody who needs a vertex in the scene
// takes it from here, so that tracer, emitters and bounds agree to the last bit. Threads: pure
// functions.
#pragma once

#include "common/scene/scene.h"

namespace ninefold {

inline Vec3 worldPoint(const DMat4& toWorld, Vec3 p) {
  return Vec3(DVec3(toWorld * DVec4(DVec3(p), 1.0)));
}

// True if the instance mirrors: its triangles then turn the other way round, and their front is on
// the other side of cross(b - a, c - a).
inline bool mirrors(const DMat4& toWorld) { return glm::determinant(DMat3(toWorld)) < 0; }

// Box of all instances.
Bounds boundsOf(const Scene& scene);

}  // namespace ninefold
