#include "common/tracing/surface.h"

#include "common/math/rounding.h"

namespace ninefold {

Vec3 offsetOrigin(Vec3 position, Vec3 n, float error, Vec3 direction) {
  // Storing the new origin rounds once more; 1.01 covers the roundings of the bounds themselves.
  const float distance = 1.01f * (error + storageError(position, n) + kUnitRoundoff * error);
  return position + (glm::dot(direction, n) < 0 ? -distance : distance) * n;
}

Vec3 offsetOrigin(const SurfacePoint& p, Vec3 direction) {
  return offsetOrigin(p.position, p.geometricNormal, p.error, direction);
}

}  // namespace ninefold
