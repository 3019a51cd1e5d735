#include "common/gi/photon_footprint.h"

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
constexpr float kLayerGap = 1e-4f;  // [r] behind a hit the search goes on

}  // namespace

float photonFootprint(const Transport& t, const ShadingPoint& at, Metres r, float turn) {
  const Vec3 x = at.surface.position, n = at.ng;
  const Basis basis(n);
  RayPacket rays;
  Hit hits[kPacket];
  for (int i = 0; i < kPacket; ++i) {
    const Vec2 d = r * diskPoint(i, turn);
    const Vec3 above = x + d.x * basis.tangent + d.y * basis.bitangent + r * n;
    rays.set(i, above, -n, 0, 2 * r);
  }
  uint32_t active = 0xffff;
  float covered = 0;
  for (int layer = 0; layer < kMostLayers && active != 0; ++layer) {
    t.tracer.closest16(rays, active, hits);
    for (int i = 0; i < kPacket; ++i) {
      if ((active >> i & 1u) == 0) continue;
      if (!hits[i]) {
        active &= ~(1u << i);
        continue;
      }
      const SurfacePoint s = t.tracer.surface(hits[i]);
      const Vec3 off = s.position - x;
      // The photon's own mesh is wound as it is there; of all others the fronts are seen.
      const bool turned = s.instance == at.surface.instance && !at.front;
      const float cosine = glm::dot(s.geometricNormal, turned ? -n : n);
      const bool accepts = t.shader.mayBeDiffuse(s.material) && cosine > kPhotonNormalCosine;
      if (accepts && glm::dot(off, off) <= r * r) covered += 1 / cosine;
      rays.nearT[i] = hits[i].t + kLayerGap * r, rays.farT[i] = 2 * r;
    }
  }
  return std::max(covered, 1.0f) / kPacket;
}

}  // namespace ninefold
