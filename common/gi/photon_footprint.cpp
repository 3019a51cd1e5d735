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

}  // namespace

float photonFootprint(const Transport& t, Vec3 x, Vec3 n, Metres r, float turn) {
  const Basis basis(n);
  const float height = 0.5f * r;
  RayPacket rays;
  Hit hits[kPacket];
  for (int i = 0; i < kPacket; ++i) {
    const Vec2 d = r * diskPoint(i, turn);
    const Vec3 above = x + d.x * basis.tangent + d.y * basis.bitangent + height * n;
    rays.set(i, above, -n, 0, 2 * height);
  }
  t.tracer.closest16(rays, 0xffff, hits);
  float covered = 0;
  for (const Hit& hit : hits) {
    if (!hit) continue;
    const SurfacePoint s = t.tracer.surface(hit);
    const Vec3 off = s.position - x;
    const float cosine = std::abs(glm::dot(s.geometricNormal, n));
    if (cosine > kPhotonNormalCosine && glm::dot(off, off) <= r * r) covered += 1 / cosine;
  }
  return std::max(covered, 1.0f) / kPacket;
}

}  // namespace ninefold
