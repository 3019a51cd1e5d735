#include "common/gi/vpl/indirect_vpls.h"

#include <bit>

#include "common/gi/light/light_path.h"

namespace ninefold {
namespace {

constexpr int kPilotLog2 = 10;
constexpr int kMaxPathsLog2 = 20;

// Walks 2^pathsLog2 particles of block k of a stream and hands each D or glossy vertex to
// deposit(arrival, lamp).
template <typename Deposit>
void walkIndirect(const Transport& t, size_t stream, SampleUse use, uint32_t randomization, int k,
                  int pathsLog2, RayCounts& rays, Deposit&& deposit) {
  const LightSampler sampler(LightStreams::seedOf(stream, t.settings.seed), use, randomization,
                             static_cast<uint32_t>(k), pathsLog2, t.settings.randomization);
  for (uint32_t i = 0; i < 1u << pathsLog2; ++i) {
    const Particle start = emitParticle(t, stream, sampler.get2D(i, 0), sampler.get2D(i, 2));
    walkLightPath(t, start, {}, 0, sampler, i, 4, rays, [&](const Arrival& a) {
      const Bsdf& bsdf = a.point->bsdf;
      if ((!isBlack(bsdf.diffuse) && t.allows(a.diffuseBefore + 2)) ||
          (isGlossy(bsdf) && t.allows(a.diffuseBefore + 1)))
        deposit(a, start.lamp);
      return t.allows(a.diffuseBefore + (t.needs.glossy ? 2 : 3));
    });
  }
}

Vpl indirectVpl(const Transport& t, const Arrival& a, float share) {
  const ShadingPoint& p = *a.point;
  Vpl vpl;
  vpl.position = p.surface.position, vpl.error = p.surface.error;
  vpl.normal = p.ng;
  vpl.power = share / t.shader.squaredIndex(a.media) * kInvPi * shadingFactor(p, p.ns, p.wo) *
              p.bsdf.diffuse * a.flux;
  vpl.diffuseCount = a.diffuseBefore + 1, vpl.bound = t.bound;
  vpl.media = a.media;
  return vpl;
}

// One VPL for both lobes, D and glossy. Eye paths give back what its bound cuts off
// (compensation.h). Where they cannot find the light, the glossy lobe has a VPL of its own, without
// a bound.
void depositVpls(const Transport& t, const Arrival& a, uint32_t lamp, float share, VplSet& set) {
  Vpl vpl = indirectVpl(t, a, share);
  vpl.lamp = lamp;
  const ShadingPoint& p = *a.point;
  const bool glossy = isGlossy(p.bsdf);
  if (glossy && a.hidden) {
    set.vpls.push_back(vpl);
    vpl.power = Vec3(0), vpl.bound = std::numeric_limits<float>::infinity();
  }
  if (glossy) {
    vpl.glossy = static_cast<int>(set.glossy.size());
    set.glossy.push_back(
        {p.bsdf, p.ns, p.ng, p.wo, share / t.shader.squaredIndex(a.media) * a.flux});
  }
  set.vpls.push_back(vpl);
}

void addOfStream(const Transport& t, size_t stream, SampleUse use, uint32_t randomization, int k,
                 int pathsLog2OfFirst, VplSet& set, RayCounts& rays) {
  const auto wanted = static_cast<unsigned>(t.streams.samples(stream, 1 << pathsLog2OfFirst));
  const int pathsLog2 = std::bit_width(wanted) - 1;
  const float share = 1 / static_cast<float>(1u << pathsLog2);
  walkIndirect(t, stream, use, randomization, k, pathsLog2, rays,
               [&](const Arrival& a, uint32_t lamp) { depositVpls(t, a, lamp, share, set); });
}

}  // namespace

int lightPathsLog2(const Transport& t, int meanVpls) {
  if (t.emitters.empty() || meanVpls == 0 || !t.allows(t.needs.glossy ? 1 : 2)) return -1;
  RayCounts rays;
  uint64_t vertices = 0;
  for (size_t stream = 0; stream < t.streams.count(); ++stream)
    walkIndirect(t, stream, SampleUse::probe, 0, 0, kPilotLog2, rays,
                 [&](const Arrival&, uint32_t) { ++vertices; });
  if (vertices == 0) return -1;
  const double mean = static_cast<double>(vertices) / (1 << kPilotLog2);
  const double wanted = std::log2(meanVpls / mean);
  return std::clamp(static_cast<int>(std::lround(wanted)), 0, kMaxPathsLog2);
}

void addIndirectVpls(const Transport& t, const FrameKey& frame, int k, int pathsLog2, VplSet& set,
                     RayCounts& rays) {
  for (size_t stream = 0; stream < t.streams.count(); ++stream)
    addOfStream(t, stream, SampleUse::lightPath, frame.randomization, k, pathsLog2, set, rays);
}

void addPilotVpls(const Transport& t, int pathsLog2, VplSet& set, RayCounts& rays) {
  for (size_t stream = 0; stream < t.streams.count(); ++stream)
    addOfStream(t, stream, SampleUse::probe, 1, 0, pathsLog2, set, rays);
}

}  // namespace ninefold
