#include "common/tracing/alpha_mask.h"

#include "common/scene/texture.h"

namespace ninefold {
namespace {

Vec2 interpolateUv(const std::vector<Vec2>& uv, const Triangle& t, float u, float v) {
  return uv.empty() ? Vec2(0) : (1 - u - v) * uv[t.x] + u * uv[t.y] + v * uv[t.z];
}

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
  const Triangle& t = mesh->triangles[triangle];
  float alpha = material->opacity * colorAt(*mesh, t, u, v).w;
  if (material->baseColorMap) {
    alpha *= lookUp(*scene, material->baseColorMap, interpolateUv(mesh->uv0, t, u, v),
                    interpolateUv(mesh->uv1, t, u, v))
                 .w;
  }
  return alpha < material->alphaCutoff;
}

void attachAlphaMask(RTCGeometry geometry, const AlphaMask& mask) {
  rtcSetGeometryUserData(geometry, const_cast<AlphaMask*>(&mask));
  rtcSetGeometryIntersectFilterFunction(geometry, rejectOpenTexels);
  rtcSetGeometryOccludedFilterFunction(geometry, rejectOpenTexels);
}

}  // namespace ninefold
