#include "common/gi/elements/surface_sight.h"

namespace ninefold {
namespace {

uint8_t mainAxis(Vec3 n) {
  const Vec3 a = glm::abs(n);
  const int axis = a.x >= a.y ? (a.x >= a.z ? 0 : 2) : (a.y >= a.z ? 1 : 2);
  return static_cast<uint8_t>(2 * axis + (n[axis] < 0 ? 1 : 0));
}

}  // namespace

uint8_t SurfaceSight::hides(Vec3 x, Vec3 normal, Vec3 to) const {
  Vec3 way = to - x;
  way -= glm::dot(way, normal) * normal;
  const float length = glm::length(way);
  if (!(length > 0)) return kFree;
  way *= 1 + kBeyond * size / length;
  const Hit hit = tracer.closest(x + kAbove * size * normal, way, 1);
  if (!hit) return kFree;
  if (isFlat(hit, normal)) return kFree;
  const Vec3 front = tracer.frontNormal(hit.instance, hit.triangle);
  const bool isFront = glm::dot(front, way) < 0;
  return static_cast<uint8_t>(1 + 2 * mainAxis(isFront ? front : -front) + (isFront ? 0 : 1));
}

bool SurfaceSight::isCovered(uint32_t instance, uint32_t triangle, Vec2 uv, bool isBack) const {
  const SurfacePoint p = tracer.surface({instance, triangle, uv.x, uv.y, 0});
  const Vec3 away = isBack ? -p.geometricNormal : p.geometricNormal;
  return tracer.occluded(offsetOrigin(p, away), kTouch * size * away, 1);
}

}  // namespace ninefold
