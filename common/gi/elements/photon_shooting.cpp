#include "common/gi/elements/photon_shooting.h"

#include <algorithm>
#include <cmath>

namespace ninefold {
namespace {

uint16_t placeOf(float barycentric) {
  return static_cast<uint16_t>(std::lround(65535 * std::clamp(barycentric, 0.0f, 1.0f)));
}

}  // namespace

float fluxOfLamps(const Transport& t) {
  // Emitters reckon with a beam of the scene's radius.
  const double widening = double{coverRadius(t.scene)} / double{t.radius};
  glm::dvec3 sum(0);
  for (size_t i = 0; i < t.emitters.size(); ++i) {
    const EmitterKind kind = t.emitters[i].kind;
    const bool isBeam = kind == EmitterKind::directional || kind == EmitterKind::environment;
    sum += (isBeam ? widening * widening : 1) * glm::dvec3(t.emitters[i].flux);
  }
  return static_cast<float>(std::max({sum.x, sum.y, sum.z}));
}

std::vector<PhotonStream> photonStreams(const Transport& t, SampleUse use, uint32_t randomization) {
  std::vector<PhotonStream> streams;
  for (size_t s = 0; s < t.streams.count(); ++s) {
    const uint64_t seed = LightStreams::seedOf(s, t.settings.seed);
    streams.push_back({s, HaltonSampler(seed, use, randomization)});
  }
  return streams;
}

PhotonStart photonStart(const Transport& t, const MinorLamps& minor, const PhotonStream& stream,
                        uint32_t photon) {
  const Particle particle = emitAlike(t, stream.index, stream.numbers.lampAndDirection(photon),
                                      stream.numbers.place(photon));
  return {particle, t.settings.directVpls > 0 && minor.has(particle.lamp)};
}

bool isForElements(const Transport& t, const Arrival& a, bool isOfMinorLamp) {
  // A texel without D counts as area of its element all the same, so that its hits must count, too.
  return (a.turned || isOfMinorLamp) && !a.focused &&
         t.shader.mayBeDiffuse(a.point->surface.material) && t.allows(a.diffuseBefore + 1);
}

ElementHit elementHit(const Transport& t, const SurfaceNumbers& surfaces, const Arrival& a,
                      float share, uint64_t word) {
  const ShadingPoint& p = *a.point;
  const Flux flux = share / t.shader.squaredIndex(a.media) * shadingFactor(p, p.ns, p.wo) * a.flux;
  return {surfaces.numberOf({p.surface.instance, p.surface.triangle, !p.front}),
          placeOf(p.surface.u), placeOf(p.surface.v), packFlux(flux, word)};
}

void thinHits(PhotonRow& row, size_t room, uint64_t word) {
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

}  // namespace ninefold
