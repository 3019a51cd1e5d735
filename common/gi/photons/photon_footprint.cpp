#include "common/gi/photons/photon_footprint.h"

#include <bit>

namespace ninefold {
namespace {

constexpr float kGoldenAngle = 2.39996323f;  // turns rings against each other: even coverage

// Point of the pattern, in units of r: rings of equal area.
Vec2 diskPoint(int i, float turn) {
  const float radius = std::sqrt((static_cast<float>(i) + 0.5f) / kPacket);
  const float angle = 2 * kPi * turn + kGoldenAngle * static_cast<float>(i);
  return radius * Vec2(std::cos(angle), std::sin(angle));
}

constexpr int kMostLayers = 8;
constexpr float kLayerGap = 1e-3f;  // [height] behind a hit the search goes on

// Along -n from as far above the disk as receivers may be to as far below it.
RayPacket raysThrough(const ShadingPoint& at, Metres r, float turn) {
  const Basis basis(at.ng);
  const Metres height = kPhotonHeight * r;
  RayPacket rays;
  for (int i = 0; i < kPacket; ++i) {
    const Vec2 d = r * diskPoint(i, turn);
    const Vec3 above =
        at.surface.position + d.x * basis.tangent + d.y * basis.bitangent + height * at.ng;
    rays.set(static_cast<size_t>(i), above, -at.ng, 0, 2 * height);
  }
  return rays;
}

// 1/cos of what a ray met: its area over that of its shadow on the disk. 0 if it accepts no photon.
float acceptance(const Transport& t, const ShadingPoint& at, Metres r, const SurfacePoint& s) {
  const Vec3 off = s.position - at.surface.position;
  if (!t.shader.mayBeDiffuse(s.material) || glm::dot(off, off) > r * r) return 0;
  // The photon's own mesh is wound as it is there; of all others the fronts are seen.
  const bool turned = s.instance == at.surface.instance && !at.front;
  const float cosine = glm::dot(s.geometricNormal, turned ? -at.ng : at.ng);
  return cosine > kPhotonNormalCosine ? 1 / cosine : 0.0f;
}

}  // namespace

float photonFootprint(const Transport& t, const ShadingPoint& at, Metres r, float turn,
                      RayCounts& counts) {
  RayPacket rays = raysThrough(at, r, turn);
  Hit hits[kPacket];
  uint32_t active = 0xffff;
  float covered = 0;
  for (int layer = 0; layer < kMostLayers && active != 0; ++layer) {
    counts.photon += static_cast<uint64_t>(std::popcount(active));
    t.tracer.closest16(rays, active, hits);
    for (int i = 0; i < kPacket; ++i) {
      if ((active >> i & 1u) == 0) continue;
      const float accepted = hits[i] ? acceptance(t, at, r, t.tracer.surface(hits[i])) : 0.0f;
      covered += accepted;
      if (!hits[i] || accepted > 0) active &= ~(1u << i);
      rays.nearT[i] = hits[i].t + kLayerGap * kPhotonHeight * r;
    }
  }
  return std::max(covered, 1.0f) / kPacket;
}

}  // namespace ninefold
