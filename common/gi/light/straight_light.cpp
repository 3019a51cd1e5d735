#include "common/gi/light/straight_light.h"

#include <algorithm>

#include "common/math/box_rays.h"
#include "common/math/rounding.h"

namespace ninefold {
namespace {

bool mayPass(const std::vector<Bounds>& bounds, Vec3 origin, Vec3 segment, float tFar) {
  return std::ranges::any_of(bounds,
                             [&](const Bounds& b) { return meetsBox(b, origin, segment, tFar); });
}

}  // namespace

Vec3 straightVisibility(const Transport& t, Vec3 origin, Vec3 segment, float tFar, uint64_t& rays) {
  if (!mayPass(t.straightBounds, origin, segment, tFar)) return Vec3(0);
  const Vec3 end = origin + (std::isfinite(tFar) ? tFar : 0.0f) * segment;
  const Vec3 back = -glm::normalize(segment);
  Vec3 left(1);
  for (int met = 0; met <= t.settings.specularDepth; ++met) {
    ++rays;
    const Hit hit = t.tracer.closest(origin, segment, tFar);
    if (!hit) return left;
    const SurfacePoint s = t.tracer.surface(hit);
    if (!t.shader.passesStraight(s)) return Vec3(0);
    left *= straightPass(t.shader.shade(s, back, {}));
    if (isBlack(left)) return Vec3(0);
    origin = offsetOrigin(s, -back);
    if (std::isfinite(tFar)) segment = end - origin, tFar = 1;
  }
  return Vec3(0);
}

}  // namespace ninefold
