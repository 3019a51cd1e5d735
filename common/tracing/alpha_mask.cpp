#include "common/tracing/alpha_mask.h"

#include "common/scene/alpha_test.h"

namespace ninefold {
namespace {

// Embree's view of up to 16 hits that it is about to accept; valid[i] = 0 rejects one.
void rejectOpenTexels(const RTCFilterFunctionNArguments* arguments) {
  const auto& mask = *static_cast<const AlphaMask*>(arguments->geometryUserPtr);
  const unsigned count = arguments->N;
  for (unsigned i = 0; i < count; ++i) {
    if (arguments->valid[i] == 0) continue;
    RTCHitN* hit = arguments->hit;
    if (mask.isOpen(RTCHitN_primID(hit, count, i), RTCHitN_u(hit, count, i),
                    RTCHitN_v(hit, count, i)))
      arguments->valid[i] = 0;
  }
}

}  // namespace

bool AlphaMask::isOpen(uint32_t triangle, float u, float v) const {
  return isOpenAt(*scene, *mesh, triangle, u, v);
}

void attachAlphaMask(RTCGeometry geometry, const AlphaMask& mask) {
  rtcSetGeometryUserData(geometry, const_cast<AlphaMask*>(&mask));
  rtcSetGeometryIntersectFilterFunction(geometry, rejectOpenTexels);
  rtcSetGeometryOccludedFilterFunction(geometry, rejectOpenTexels);
}

}  // namespace ninefold
