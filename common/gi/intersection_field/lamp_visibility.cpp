#include "common/gi/intersection_field/lamp_visibility.h"

#include <algorithm>
#include <optional>

#include "common/gi/light/straight_light.h"
#include "common/state/fixed_point.h"

namespace ninefold {
namespace {

// The fraction of 1 that number k adds to u.
float shifted(float u, size_t k) {
  const float sum = u + 0.618034f * static_cast<float>(k);
  return sum - std::floor(sum);
}

}  // namespace

LampVisibility::LampVisibility(const Transport& transport, const LineField& field,
                               const SceneElements& elements, const LampVisibility* before)
    : t_(transport), scene_(transport, field, elements), lamps_(areaLamps(transport)) {
  LampLines now(scene_);
  std::optional<LampLines> then;
  if (before != nullptr) then.emplace(before->scene_);
  for (const AreaLamp& lamp : lamps_) {
    const LampPairs* known = before == nullptr ? nullptr : before->pairsOf(lamp.instance);
    pairs_.push_back(std::make_unique<const LampPairs>(now, lamp, known, then ? &*then : nullptr));
  }
}

const LampPairs* LampVisibility::pairsOf(uint32_t instance) const {
  const auto found = std::ranges::find(lamps_, instance, &AreaLamp::instance);
  return found == lamps_.end() ? nullptr
                               : pairs_[static_cast<size_t>(found - lamps_.begin())].get();
}

uint64_t LampVisibility::lines() const {
  uint64_t sum = 0;
  for (const auto& pairs : pairs_) sum += pairs->lines();
  return sum;
}

size_t LampVisibility::bytes() const {
  size_t sum = 0;
  for (const auto& pairs : pairs_) sum += pairs->bytes();
  return sum;
}

LampVisibility::Share LampVisibility::at(const LampPairs& pairs,
                                         const SurfaceNumbers::Surface& surface, float u,
                                         float v) const {
  const ElementPlace place = scene_.elements.block(surface.instance).at(surface.triangle, u, v);
  Share share;
  for (size_t c = 0; c < 3; ++c) {
    const LampPairs::Sums* sums =
        pairs.sumsOf(surface.instance, place.nodes[c], surface.isBack != place.isTurned);
    if (sums == nullptr) return share;
    const auto number = [&](int64_t sum) {
      return place.weights[c] * static_cast<float>(fromFixed(sum, LampPairs::kQuantum));
    };
    share.all += number(sums->all);
    share.seen += Vec3(number(sums->seen[0]), number(sums->seen[1]), number(sums->seen[2]));
  }
  return share;
}

// By one ray to a disk that is chosen in proportion to what it would send.
Irradiance LampVisibility::traced(const std::vector<Irradiance>& shares, const AreaLamp& lamp,
                                  const Receivers& receivers, size_t i, float u,
                                  RayCounts& rays) const {
  float left = 0;
  for (const Irradiance& share : shares) left += maxComponent(share);
  const float all = left;
  left *= u;
  size_t k = 0;
  while (k + 1 < shares.size() && left >= maxComponent(shares[k]))
    left -= maxComponent(shares[k++]);
  if (isBlack(shares[k])) return Irradiance(0);
  const LampDisk& disk = lamp.disks[k];
  const Vec3 origin = receivers.origin(i);
  const bool fromFront = glm::dot(disk.normal, origin - disk.position) > 0;
  const Vec3 way =
      t_.rayTarget(disk.position, fromFront ? disk.normal : -disk.normal, disk.error) - origin;
  const Irradiance whole = all / maxComponent(shares[k]) * shares[k];
  ++rays.shadow;
  if (!t_.tracer.occluded(origin, way, 1)) return whole;
  if (t_.straightBounds.empty()) return Irradiance(0);
  return whole * straightVisibility(t_, origin, way, 1, rays.shadow);
}

void LampVisibility::gather(const ReceiverSamples& samples, int pathVertices, Receivers& receivers,
                            RayCounts& rays) const {
  std::vector<Irradiance> shares(AreaLamp::kDisks);
  for (size_t i = 0; i < receivers.size(); ++i) {
    const uint32_t object = receivers.object[i], triangle = receivers.triangle[i];
    const Vec3 x = receivers.position(i), ng = receivers.ng(i), ns = receivers.ns(i);
    const bool isBack = glm::dot(ng, t_.tracer.frontNormal(object, triangle)) < 0;
    for (size_t k = 0; k < lamps_.size(); ++k) {
      const AreaLamp& lamp = lamps_[k];
      Irradiance h(0);
      for (size_t d = 0; d < lamp.disks.size(); ++d) {
        shares[d] = unshadowed(lamp, lamp.disks[d], x, ng, ns);
        if (receivers.absorber[i] >= 0)
          shares[d] *= t_.shader.transmittance(receivers.absorber[i],
                                               glm::length(lamp.disks[d].position - x));
        h += shares[d];
      }
      if (isBlack(h)) continue;
      const Share pairs =
          at(*pairs_[k], {object, triangle, isBack}, receivers.u[i], receivers.v[i]);
      // No compensation asks for this number: it has no bounded light here.
      const float u = shifted(samples.compensationRoulette(receivers.pixel[i], pathVertices), k);
      receivers.addIrradiance(i, pairs.all >= kFewest
                                     ? h * pairs.seen / pairs.all
                                     : traced(shares, lamp, receivers, i, u, rays));
    }
  }
}

}  // namespace ninefold
