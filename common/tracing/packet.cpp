#include "common/tracing/packet.h"

#include <bit>
#include <cstddef>
#include <cstring>

namespace ninefold {
namespace {

// A RayPacket is handed to Embree as it is.
static_assert(sizeof(RayPacket) == sizeof(RTCRay16) && alignof(RayPacket) == alignof(RTCRay16));
static_assert(offsetof(RayPacket, originX) == offsetof(RTCRay16, org_x));
static_assert(offsetof(RayPacket, nearT) == offsetof(RTCRay16, tnear));
static_assert(offsetof(RayPacket, directionX) == offsetof(RTCRay16, dir_x));
static_assert(offsetof(RayPacket, directionZ) == offsetof(RTCRay16, dir_z));
static_assert(offsetof(RayPacket, time) == offsetof(RTCRay16, time));
static_assert(offsetof(RayPacket, farT) == offsetof(RTCRay16, tfar));
static_assert(offsetof(RayPacket, mask) == offsetof(RTCRay16, mask));
static_assert(offsetof(RayPacket, flags) == offsetof(RTCRay16, flags));

constexpr int kHalf = kPacket / 2;
constexpr size_t kRayFields = sizeof(RTCRay16) / (kPacket * sizeof(float));

// Embree's lane masks: -1 = trace, 0 = leave alone.
struct alignas(64) LaneMask {
  int lane[kPacket];
  explicit LaneMask(uint32_t active) {
    for (int i = 0; i < kPacket; ++i) lane[i] = (active >> i & 1) != 0 ? -1 : 0;
  }
};

// Without their sign, floats are ordered as their bits are, and NaN comes after infinity.
uint32_t magnitude(float x) { return std::bit_cast<uint32_t>(x) & 0x7fffffffu; }
constexpr uint32_t kMaxMagnitude = std::bit_cast<uint32_t>(kMaxCoordinate);
constexpr uint32_t kInfinity = 0x7f800000u;

// Copies `fields` planes of eight lanes between a packet of 8 and a half of a packet of 16.
void copyHalf(void* eight, const void* sixteen, int half, size_t fields) {
  for (size_t field = 0; field < fields; ++field)
    std::memcpy(static_cast<float*>(eight) + field * kHalf,
                static_cast<const float*>(sixteen) + field * kPacket + size_t(half) * kHalf,
                kHalf * sizeof(float));
}

void intersectHalf(const Hierarchies& parts, const int* valid, bool coherent, int half,
                   RTCRayHit16& query) {
  RTCRayHit8 eight;
  copyHalf(&eight.ray, &query.ray, half, kRayFields);
  std::fill_n(eight.hit.geomID, kHalf, RTC_INVALID_GEOMETRY_ID);
  for (const SeenPart& part : parts) {
    std::fill_n(eight.ray.mask, kHalf, part.mask);
    embree::intersect8(part.hierarchy, valid, &eight, coherent);
  }
  const int first = half * kHalf;
  std::copy_n(eight.ray.tfar, kHalf, query.ray.tfar + first);
  std::copy_n(eight.hit.u, kHalf, query.hit.u + first);
  std::copy_n(eight.hit.v, kHalf, query.hit.v + first);
  std::copy_n(eight.hit.primID, kHalf, query.hit.primID + first);
  std::copy_n(eight.hit.geomID, kHalf, query.hit.geomID + first);
}

void occludedHalf(RTCScene part, const int* valid, bool coherent, int half, RayPacket& rays) {
  RTCRay8 eight;
  copyHalf(&eight, &rays, half, kRayFields);
  embree::occluded8(part, valid, &eight, coherent);
  std::copy_n(eight.tfar, kHalf, rays.farT + half * kHalf);
}

void occludedBy(const SeenPart& part, bool wide, bool coherent, uint32_t active, RayPacket& rays) {
  const LaneMask valid(active);
  std::fill_n(rays.mask, kPacket, part.mask);
  if (wide) {
    embree::occluded16(part.hierarchy, valid.lane, reinterpret_cast<RTCRay16*>(&rays), coherent);
    return;
  }
  occludedHalf(part.hierarchy, valid.lane, coherent, 0, rays);
  occludedHalf(part.hierarchy, valid.lane + kHalf, coherent, 1, rays);
}

uint32_t blockedLanes(const RayPacket& rays) {
  uint32_t blocked = 0;
  for (uint32_t i = 0; i < kPacket; ++i) blocked |= rays.farT[i] < 0 ? 1u << i : 0u;
  return blocked;
}

}  // namespace

uint32_t traceable(const RayPacket& rays, uint32_t active) {
  uint32_t bits[kPacket];
  for (int i = 0; i < kPacket; ++i) {
    const uint32_t largest =
        std::max({magnitude(rays.originX[i]), magnitude(rays.originY[i]),
                  magnitude(rays.originZ[i]), magnitude(rays.directionX[i]),
                  magnitude(rays.directionY[i]), magnitude(rays.directionZ[i])});
    const uint32_t ends = std::max(magnitude(rays.nearT[i]), magnitude(rays.farT[i]));
    bits[i] = largest < kMaxMagnitude && ends <= kInfinity ? 1u << i : 0u;
  }
  uint32_t lanes = 0;
  for (int i = 0; i < kPacket; ++i) lanes |= bits[i];
  return lanes & active;
}

bool traceable(Vec3 origin, Vec3 direction, float tFar) {
  const auto small = [](float x) { return magnitude(x) < kMaxMagnitude; };
  return small(origin.x) && small(origin.y) && small(origin.z) && small(direction.x) &&
         small(direction.y) && small(direction.z) && magnitude(tFar) <= kInfinity;
}

void intersectPacket(const Hierarchies& parts, bool wide, bool coherent, const RayPacket& rays,
                     uint32_t active, RTCRayHit16& query) {
  std::memcpy(&query.ray, &rays, sizeof rays);
  std::fill_n(query.hit.geomID, kPacket, RTC_INVALID_GEOMETRY_ID);
  const LaneMask valid(active);
  if (wide) {
    for (const SeenPart& part : parts) {
      std::fill_n(query.ray.mask, kPacket, part.mask);
      embree::intersect16(part.hierarchy, valid.lane, &query, coherent);
    }
    return;
  }
  intersectHalf(parts, valid.lane, coherent, 0, query);
  intersectHalf(parts, valid.lane + kHalf, coherent, 1, query);
}

uint32_t occludedPacket(const Hierarchies& parts, bool wide, bool coherent, uint32_t active,
                        RayPacket& rays) {
  uint32_t open = active;
  for (const SeenPart& part : parts) {
    occludedBy(part, wide, coherent, open, rays);
    open &= ~blockedLanes(rays);
    if (open == 0) break;
  }
  return active & ~open;
}

}  // namespace ninefold
