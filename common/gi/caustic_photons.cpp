#include "common/gi/caustic_photons.h"

#include <bit>

namespace ninefold {
namespace {

constexpr float kMinNormalCosine = 0.5f;
constexpr uint32_t kWalkDimension = 8;  // after the joint four of the start and one padded group

int log2Ceil(int n) { return n <= 1 ? 0 : std::bit_width(static_cast<unsigned>(n - 1)); }

// Follows a photon through S vertices and stores it at the first D vertex behind one.
void tracePhoton(const Transport& t, const Particle& start, const MediumStack& media,
                 int diffuseBefore, float share, const LightSampler& sampler, uint32_t i,
                 RayCounts& rays, std::vector<Photon>& out) {
  walkLightPath(
      t, start, media, diffuseBefore, sampler, i, kWalkDimension, rays, [&](const Arrival& a) {
        const ShadingPoint& p = *a.point;
        if (a.fromSpecular && !isBlack(p.bsdf.diffuse)) {
          const Flux flux =
              share / t.shader.squaredIndex(a.media) * shadingFactor(p, p.ns, p.wo) * a.flux;
          if (!isBlack(flux)) out.push_back({p.surface.position, p.ng, flux, a.diffuseBefore});
        }
        return false;  // what scatters diffusely here is the VPLs' part
      });
}

void photonsFromEmitters(const Transport& t, const FrameKey& frame, int k, int count,
                         RayCounts& rays, std::vector<Photon>& out) {
  const LightSampler sampler(t.settings.seed, SampleUse::photon, frame.randomization,
                             static_cast<uint32_t>(k), log2Ceil(count), t.settings.randomization);
  for (uint32_t i = 0; i < static_cast<uint32_t>(count); ++i) {
    const Particle start =
        emitAimed(t, sampler.get2D(i, 0), sampler.get2D(i, 2), sampler.get1D(i, 4));
    tracePhoton(t, start, {}, 0, 1.0f / static_cast<float>(count), sampler, i, rays, out);
  }
}

void photonsFromVpls(const Transport& t, const FrameKey& frame, int k, int count,
                     const std::vector<const Vpl*>& sources, RayCounts& rays,
                     std::vector<Photon>& out) {
  std::vector<float> weights;
  for (const Vpl* vpl : sources) weights.push_back(maxComponent(vpl->power));
  const Distribution byFlux(weights);
  if (byFlux.empty()) return;
  const LightSampler sampler(t.settings.seed, SampleUse::indirectPhoton, frame.randomization,
                             static_cast<uint32_t>(k), log2Ceil(count), t.settings.randomization);
  for (uint32_t i = 0; i < static_cast<uint32_t>(count); ++i) {
    const Distribution::Choice choice = byFlux.choose(sampler.get1D(i, 0));
    const Vpl& vpl = *sources[choice.index];
    const LambertSource source{
        vpl.position, vpl.normal, vpl.error,
        kPi * t.shader.squaredIndex(vpl.media) / choice.probability * vpl.power};
    const Particle start = emitAimed(t, source, sampler.get2D(i, 2), sampler.get1D(i, 1));
    tracePhoton(t, start, vpl.media, vpl.diffuseCount, 1.0f / static_cast<float>(count), sampler, i,
                rays, out);
  }
}

}  // namespace

std::vector<Photon> makeCausticPhotons(const Transport& t, const FrameKey& frame, int k,
                                       const std::vector<Vpl>& vpls, RayCounts& rays) {
  std::vector<Photon> photons;
  const Settings& s = t.settings;
  if (s.caustics == Caustics::off || s.photons == 0 || !t.needs.specular() || t.emitters.empty())
    return photons;
  std::vector<const Vpl*> sources;
  if (s.caustics == Caustics::all)
    for (const Vpl& vpl : vpls)
      if (vpl.diffuseCount > 0) sources.push_back(&vpl);
  // The split does not depend on what this set's walks happened to find: that would bias both
  // halves.
  // A single photon has no half: it becomes one of each.
  const bool all = s.caustics == Caustics::all && t.allows(2);
  const int fromVpls = all ? std::max(s.photons / 2, 1) : 0;
  photonsFromEmitters(t, frame, k, std::max(s.photons - fromVpls, 1), rays, photons);
  if (fromVpls > 0) photonsFromVpls(t, frame, k, fromVpls, sources, rays, photons);
  return photons;
}

Irradiance gatherPhotons(const Transport& t, const PhotonGrid& grid, Vec3 position, Vec3 n,
                         int pathVertices) {
  Flux sum(0);
  grid.near(position, [&](const Photon& photon) {
    const bool counts = t.allows(photon.diffuseBefore + pathVertices);
    if (counts && glm::dot(photon.normal, n) > kMinNormalCosine) sum += photon.flux;
  });
  return sum / (kPi * grid.radius() * grid.radius());
}

}  // namespace ninefold
