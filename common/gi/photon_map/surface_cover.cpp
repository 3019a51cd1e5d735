#include "common/gi/photon_map/surface_cover.h"

#include <bit>

namespace ninefold {
namespace {

constexpr float kGoldenAngle = 2.39996323f;  // turns rings against each other: even coverage
constexpr float kRaysThroughDisk = 32;
constexpr size_t kMostRays = 512;
constexpr int kMostLayers = 4;
constexpr float kLayerGap = 1e-3f;     // [height] behind a hit the search goes on
constexpr float kLeastCosine = 0.25f;  // no point of the group accepts what landed on steeper ones

size_t raysFor(float radius, float least) {
  const float wanted = kRaysThroughDisk * (radius / least) * (radius / least);
  const auto count = static_cast<size_t>(std::min(wanted, static_cast<float>(kMostRays)));
  return (count + kPacket - 1) / kPacket * kPacket;
}

}  // namespace

void SurfaceCover::shoot(const Transport& t, const Disks& disks, RayCounts& counts) {
  disks_ = disks;
  met_.clear(), through_.clear();
  const float radius = disks.most + disks.spread;
  const size_t count = raysFor(radius, disks.least);
  const Basis basis(disks.normal);
  for (size_t i = 0; i < count; ++i) {  // rings of equal area, the first ray in the middle
    const float at = radius * std::sqrt(static_cast<float>(i) / static_cast<float>(count));
    const float angle = 2 * kPi * disks.turn + kGoldenAngle * static_cast<float>(i);
    through_.push_back(disks.centre + at * std::cos(angle) * basis.tangent +
                       at * std::sin(angle) * basis.bitangent);
  }
  for (size_t first = 0; first < count; first += kPacket) tracePacket(t, first, counts);
}

// From above the plane to as far below.
void SurfaceCover::tracePacket(const Transport& t, size_t first, RayCounts& counts) {
  const float height = disks_.height + disks_.spread;
  RayPacket rays;
  for (size_t lane = 0; lane < kPacket; ++lane)
    rays.set(lane, through_[first + lane] + height * disks_.normal, -disks_.normal, 0, 2 * height);
  Hit hits[kPacket];
  uint32_t active = 0xffff;
  for (int layer = 0; layer < kMostLayers && active != 0; ++layer) {
    counts.photon += static_cast<uint64_t>(std::popcount(active));
    t.tracer.closest16(rays, active, hits);
    for (size_t lane = 0; lane < kPacket; ++lane) {
      if ((active >> lane & 1u) == 0) continue;
      if (!hits[lane] || meet(t, first + lane, hits[lane])) {
        active &= ~(1u << lane);
        continue;
      }
      rays.nearT[lane] = hits[lane].t + kLayerGap * height, rays.farT[lane] = 2 * height;
    }
  }
}

bool SurfaceCover::meet(const Transport& t, size_t ray, const Hit& hit) {
  const Instance& instance = t.scene.instances[hit.instance];
  if (!t.shader.mayBeDiffuse(t.scene.meshes[static_cast<size_t>(instance.mesh)].material))
    return false;
  // The points' own mesh is wound as it is there; of all others the fronts are seen.
  const bool turned = disks_.turned && hit.instance == disks_.own;
  const Vec3 front = t.tracer.frontNormal(hit.instance, hit.triangle);
  const Vec3 normal = turned ? -front : front;
  const float cosine = glm::dot(normal, disks_.normal);
  if (cosine < kLeastCosine) return false;
  const float height = disks_.height + disks_.spread;
  met_.push_back({through_[ray] + (height - hit.t) * disks_.normal, normal, 1 / cosine});
  return true;
}

float SurfaceCover::share(Vec3 x, Vec3 n, Metres r) const {
  const Vec3 onPlane = x - glm::dot(x - disks_.centre, disks_.normal) * disks_.normal;
  const float r2 = r * r;
  float rays = 0, covered = 0;
  for (const Vec3& p : through_) {
    const Vec3 off = p - onPlane;
    rays += glm::dot(off, off) <= r2 ? 1.0f : 0.0f;
  }
  for (const Met& met : met_) {
    const Vec3 off = met.position - x;
    const bool counts = glm::dot(off, off) <= r2 && glm::dot(met.normal, n) > kMapNormalCosine &&
                        std::abs(glm::dot(off, n)) <= disks_.height;
    covered += counts ? met.area : 0.0f;
  }
  return rays > 0 ? std::max(covered, 1.0f) / rays : 1.0f;
}

}  // namespace ninefold
