// surface_sight.h: what stands on a surface hides places of it from each other.
//
//   way    from x to another place, kAbove h over the surface and kBeyond h beyond that place,
//          so that what stands exactly there is met from either side
//   side   of what stands in the way, as x sees it: the main axis of its normal, and whether its
//          front or its back is met. So the two sides of a wall differ, and so do inside and
//          outside of a thing.
//
// What lies as flat as the surface itself (kFlat) hides nothing: on curved surfaces it is the
// surface.
//
// Proved:  tests/gi/node_parts_test.cpp.
// Fails:   two walls that look the same way, nearer to each other than h, are one.
// Threads: const.   Owner: refers to the tracer.   Errors: none.
#pragma once

#include <cmath>

#include "common/tracing/tracer.h"

namespace ninefold {

struct SurfaceSight {
  static constexpr uint8_t kFree = 0, kSides = 13;  // sides are 1..12

  const Tracer& tracer;
  Metres size;  // h

  // x and `to`: places on the surface; `normal`: at x, unit.
  uint8_t hides(Vec3 x, Vec3 normal, Vec3 to) const;
  // Something lies on that place of a triangle, nearer than kTouch h: no light gets between.
  bool isCovered(uint32_t instance, uint32_t triangle, Vec2 uv, bool isBack) const;
  // visit(where) for what stands between two places: 0 at `from`, 1 at `to`.
  template <typename Visit>
  void forEachStanding(Vec3 from, Vec3 normal, Vec3 to, const Visit& visit) const;

 private:
  static constexpr float kAbove = 1 / 32.0f, kBeyond = 1 / 64.0f, kFlat = 0.8f;
  static constexpr float kTouch = 1e-3f;
  static constexpr int kMostStanding = 4096;

  bool isFlat(const Hit& hit, Vec3 normal) const {
    return std::abs(glm::dot(tracer.frontNormal(hit.instance, hit.triangle), normal)) > kFlat;
  }
};

// Always from the same place: where one thing is met does not depend on the others.
template <typename Visit>
void SurfaceSight::forEachStanding(Vec3 from, Vec3 normal, Vec3 to, const Visit& visit) const {
  const float length = glm::length(to - from), end = 1 + kBeyond * size / length;
  float nearest = 0;
  for (int i = 0; i < kMostStanding && nearest <= end; ++i) {
    RayPacket ray;
    ray.set(0, from + kAbove * size * normal, to - from, nearest, end);
    Hit hit;
    tracer.closest16(ray, 1, &hit);
    if (!hit) return;
    if (!isFlat(hit, normal)) visit(hit.t);
    nearest = std::nextafter(hit.t, 2 * end);
  }
}

}  // namespace ninefold
