#include "common/gi/photon_map/shooting.h"

#include <algorithm>
#include <bit>

#include "common/gi/light/light_path.h"
#include "common/gi/light/media_around.h"

namespace ninefold {
namespace {

constexpr uint32_t kWalkDimension = 4;  // after the joint four of the start
constexpr int kLeastPaddingLog2 = 6;    // replications of fewer points would depend on each other

// The numbers of a unit's paths: a sampler, and the index of the first path in it.
struct Numbers {
  LightSampler sampler;
  uint32_t first;
};

Numbers numbersOf(const Transport& t, size_t stream, uint32_t randomization, uint32_t unit,
                  uint32_t count, const MapLayout& layout) {
  const Settings& s = t.settings;
  const uint64_t seed = LightStreams::seedOf(stream, s.seed);
  const uint32_t ofPart = layout.partOf(unit) * count;
  const auto sampler = [&](uint64_t key, Randomization kind) {
    // The whole turn is block 0. Padding permutes indices inside smaller blocks of it.
    const int log2 = std::max(kLeastPaddingLog2, static_cast<int>(std::bit_width(count)) - 1);
    return LightSampler(key, SampleUse::mapPhoton, randomization, 0, log2, kind);
  };
  switch (s.mapDistribution) {
    case MapDistribution::random:
      return {sampler(hashWords(seed, unit), Randomization::random), 0};
    case MapDistribution::frame:
      return {sampler(seed, Randomization::random), 0};
    case MapDistribution::turn:
      return {sampler(seed, Randomization::random), ofPart};
    case MapDistribution::nets:
      break;
  }
  return {sampler(seed, s.randomization), ofPart};
}

bool isOfPool(const Transport& t, const Arrival& a) {
  if (isBlack(a.point->bsdf.diffuse) || a.focused || !t.allows(a.diffuseBefore + 1)) return false;
  return a.turned || (t.settings.mapDirect == MapDirect::on && t.settings.directVpls > 0);
}

void shootStream(const Transport& t, size_t stream, uint32_t randomization, uint32_t unit,
                 const MapLayout& layout, std::vector<MapPhoton>& photons, RayCounts& rays) {
  const auto count = static_cast<uint32_t>(t.streams.samples(stream, t.settings.mapPerFrame));
  const Numbers numbers = numbersOf(t, stream, randomization, unit, count, layout);
  const float share = 1 / (static_cast<float>(count) * static_cast<float>(layout.parts()));
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t index = numbers.first + i;
    Particle start =
        emitParticle(t, stream, numbers.sampler.get2D(index, 0), numbers.sampler.get2D(index, 2));
    // A lamp may lie in a solid that its light never leaves.
    const MediumStack media = mediaAround(t, start.origin);
    start.flux *= t.shader.squaredIndex(media);
    walkLightPath(
        t, start, media, 0, numbers.sampler, index, kWalkDimension, rays, [&](const Arrival& a) {
          const ShadingPoint& p = *a.point;
          if (isOfPool(t, a)) {
            const Flux flux =
                share / t.shader.squaredIndex(a.media) * shadingFactor(p, p.ns, p.wo) * a.flux;
            if (!isBlack(flux))
              photons.push_back(
                  {p.surface.position, p.ng, flux, static_cast<uint32_t>(a.diffuseBefore)});
          }
          return t.allows(a.diffuseBefore + 2);
        });
  }
}

// Every n/room-th of n photons, from a place that u tells.
std::vector<MapPhoton> thinned(const std::vector<MapPhoton>& photons, size_t room, double u) {
  const double step = static_cast<double>(photons.size()) / static_cast<double>(room);
  std::vector<MapPhoton> kept;
  kept.reserve(room);
  for (size_t i = 0; i < room; ++i) {
    const auto place = static_cast<size_t>((static_cast<double>(i) + u) * step);
    kept.push_back(photons[std::min(place, photons.size() - 1)]);
    kept.back().flux *= static_cast<float>(step);
  }
  return kept;
}

}  // namespace

std::vector<MapPhoton> shootUnit(const Transport& t, uint32_t randomization, uint32_t unit,
                                 const MapLayout& layout, RayCounts& rays) {
  std::vector<MapPhoton> photons;
  if (t.emitters.empty()) return photons;
  for (size_t stream = 0; stream < t.streams.count(); ++stream)
    shootStream(t, stream, randomization, unit, layout, photons, rays);
  if (photons.size() <= layout.room()) return photons;
  const uint64_t word = hashWords(t.settings.seed, static_cast<uint64_t>(SampleUse::mapPhoton),
                                  randomization, layout.partOf(unit));
  return thinned(photons, layout.room(), double(unitFloat(static_cast<uint32_t>(word >> 32))));
}

}  // namespace ninefold
