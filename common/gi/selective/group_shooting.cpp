#include "common/gi/selective/group_shooting.h"

#include <cmath>

#include "common/gi/light/light_path.h"
#include "common/gi/light/media_around.h"
#include "common/gi/selective/packed_flux.h"
#include "common/sampling/halton.h"

namespace ninefold {
namespace {

constexpr double kMostWeight = 100;

bool isKept(const Transport& t, const Arrival& a, bool isMinor) {
  // A texel without D counts as area of its element all the same, so that its hits must count, too.
  return (a.turned || isMinor) && !a.focused && t.shader.mayBeDiffuse(a.point->surface.material) &&
         t.allows(a.diffuseBefore + 1);
}

uint16_t placeOf(float barycentric) {
  return static_cast<uint16_t>(std::lround(65535 * std::clamp(barycentric, 0.0f, 1.0f)));
}

// One stream of lamps, and its numbers.
struct Stream {
  size_t index;
  HaltonSampler numbers;
};

std::vector<Stream> streamsOf(const Transport& t, uint32_t randomization) {
  std::vector<Stream> streams;
  for (size_t s = 0; s < t.streams.count(); ++s) {
    const uint64_t seed = LightStreams::seedOf(s, t.settings.seed);
    streams.push_back({s, HaltonSampler(seed, SampleUse::groupPhoton, randomization)});
  }
  return streams;
}

void shootPhoton(const GroupShooting& shooting, const Stream& stream, uint32_t photon, float share,
                 std::vector<ElementHit>& hits, RayCounts& rays) {
  const Transport& t = shooting.transport;
  const SurfaceNumbers& surfaces = shooting.surfaces;
  const size_t first = hits.size();
  Particle start = emitAlike(t, stream.index, stream.numbers.lampAndDirection(photon),
                             stream.numbers.place(photon));
  // A lamp may lie in a solid that its light never leaves.
  const MediumStack media = t.needs.transmission ? mediaAround(t, start.origin) : MediumStack();
  start.flux *= t.shader.squaredIndex(media);
  const bool isMinor = t.settings.directVpls > 0 && shooting.minor.has(start.lamp);
  walkLightPath(
      t, start, media, 0, stream.numbers, photon, HaltonSampler::kWalkDimension, rays,
      [&](const Arrival& a) {
        const ShadingPoint& p = *a.point;
        if (isKept(t, a, isMinor)) {
          const Flux flux =
              share / t.shader.squaredIndex(a.media) * shadingFactor(p, p.ns, p.wo) * a.flux;
          const uint64_t word = hashWords(photon, stream.index, hits.size() - first);
          if (const uint32_t packed = packFlux(flux, word); packed != 0)
            hits.push_back({surfaces.numberOf({p.surface.instance, p.surface.triangle, !p.front}),
                            placeOf(p.surface.u), placeOf(p.surface.v), packed});
        }
        return t.allows(a.diffuseBefore + 2);
      });
}

// Every n/room-th of the hits, which carry as much more.
void thin(GroupRow& row, size_t room, uint64_t word) {
  std::vector<ElementHit>& hits = row.hits;
  const double step = static_cast<double>(hits.size()) / static_cast<double>(room);
  const double u = double(unitFloat(static_cast<uint32_t>(word >> 32)));
  for (size_t i = 0; i < room; ++i) {
    const auto place = static_cast<size_t>((static_cast<double>(i) + u) * step);
    ElementHit hit = hits[std::min(place, hits.size() - 1)];
    hit.flux = packFlux(static_cast<float>(step) * unpackFlux(hit.flux), hashWords(word, i));
    hits[i] = hit;
  }
  hits.resize(room);
  // Those whose place lies before a pilot's end.
  for (Pilot& pilot : row.pilots) {
    const double before = std::ceil(static_cast<double>(pilot.end) / step - u);
    pilot.end = static_cast<uint32_t>(std::clamp(before, 0.0, static_cast<double>(room)));
  }
}

}  // namespace

Pilot GroupShooting::pilotOf(const std::vector<ElementHit>& hits, size_t first,
                             double meanFlux) const {
  uint64_t signature = 0;
  double flux = 0;
  for (size_t i = first; i < hits.size(); ++i) {
    const ElementHit& h = hits[i];
    signature = hashWords(signature, uint64_t{h.surface} << 32 | h.flux, uint64_t{h.u} << 16 | h.v);
    const Flux brought = unpackFlux(h.flux);
    const float masked = masking.elevation(surfaces.surfaceOf(h.surface).instance);
    flux += double{std::max({brought.x, brought.y, brought.z}) / masked};
  }
  const double weight = meanFlux > 0 ? flux / meanFlux : 0;
  return {static_cast<uint32_t>(signature), static_cast<float>(std::min(weight, kMostWeight)),
          static_cast<uint32_t>(hits.size())};
}

GroupRow GroupShooting::shoot(uint32_t row, uint32_t randomization, uint32_t version,
                              RayCounts& rays) const {
  const Transport& t = transport;
  GroupRow left{stamp, randomization, version, lampFlux, {}, {}};
  if (t.emitters.empty()) return left;
  const double meanFlux = double{lampFlux} / groups.photons();
  const float share = 1 / static_cast<float>(groups.photons());
  const std::vector<Stream> streams = streamsOf(t, randomization);
  for (uint32_t k = 0; k < groups.photonsOf(row); ++k) {
    const size_t first = left.hits.size();
    const uint32_t photon = groups.photon(row, k);
    for (const Stream& stream : streams) shootPhoton(*this, stream, photon, share, left.hits, rays);
    if (groups.hasPilots(row)) left.pilots.push_back(pilotOf(left.hits, first, meanFlux));
  }
  if (left.hits.size() > room) thin(left, room, hashWords(t.settings.seed, randomization, row));
  return left;
}

}  // namespace ninefold
