#include "common/scene/world.h"

namespace ninefold {

Bounds boundsOf(const Scene& scene) {
  Bounds bounds;
  for (const Instance& instance : scene.instances)
    for (const Vec3& p : scene.meshes[static_cast<size_t>(instance.mesh)].positions)
      bounds.add(worldPoint(instance.toWorld, p));
  return bounds;
}

}  // namespace ninefold
