#include "common/gi/caustic_photons.h"

#include <bit>

#include "common/gi/photon_footprint.h"

namespace ninefold {
namespace {

// Indirect photons come down nearly everywhere, a few to a disk of the emitters' radius: seen as
// single bright spots. Their light varies slowly, so their disks may be wider. Measured at 8 frames:
// relMSE of a pool of water 0.44 -> 0.12, wider still gains little.
constexpr float kIndirectSpread = 4;
constexpr uint32_t kTurnDimension = 7;  // the padded group before has room
constexpr uint32_t kWalkDimension = 8;  // after the joint four of the start and one padded group

int log2Ceil(int n) { return n <= 1 ? 0 : std::bit_width(static_cast<unsigned>(n - 1)); }

// Where photons of one origin come to lie. share: 1/number of photons sent out.
struct Deposit {
  float share;
  Metres radius;
  std::vector<Photon> photons;
};

// Follows a photon through S vertices and stores it at the first D vertex behind one.
void tracePhoton(const Transport& t, const Particle& start, const MediumStack& media,
                 int diffuseBefore, const LightSampler& sampler, uint32_t i, RayCounts& rays,
                 Deposit& out) {
  walkLightPath(
      t, start, media, diffuseBefore, sampler, i, kWalkDimension, rays, [&](const Arrival& a) {
        const ShadingPoint& p = *a.point;
        if (!a.fromSpecular || isBlack(p.bsdf.diffuse)) return false;
        const Flux flux =
            out.share / t.shader.squaredIndex(a.media) * shadingFactor(p, p.ns, p.wo) * a.flux;
        if (isBlack(flux)) return false;
        const Vec3 x = p.surface.position;
        const float footprint =
            photonFootprint(t, x, p.ng, out.radius, sampler.get1D(i, kTurnDimension));
        out.photons.push_back({x, p.ng, flux / footprint, a.diffuseBefore});
        return false;  // what scatters diffusely here is the VPLs' part
      });
}

PhotonGrid photonsFromEmitters(const Transport& t, const FrameKey& frame, int k, int count,
                               RayCounts& rays) {
  Deposit out{1 / static_cast<float>(count), frame.photonRadius, {}};
  const LightSampler sampler(t.settings.seed, SampleUse::photon, frame.randomization,
                             static_cast<uint32_t>(k), log2Ceil(count), t.settings.randomization);
  for (uint32_t i = 0; i < static_cast<uint32_t>(count); ++i) {
    const Particle start =
        emitAimed(t, sampler.get2D(i, 0), sampler.get2D(i, 2), sampler.get1D(i, 4));
    tracePhoton(t, start, {}, 0, sampler, i, rays, out);
  }
  return PhotonGrid(std::move(out.photons), out.radius);
}

PhotonGrid photonsFromVpls(const Transport& t, const FrameKey& frame, int k, int count,
                           const std::vector<const Vpl*>& sources, RayCounts& rays) {
  Deposit out{1 / static_cast<float>(count), kIndirectSpread * frame.photonRadius, {}};
  std::vector<float> weights;
  for (const Vpl* vpl : sources) weights.push_back(maxComponent(vpl->power));
  const Distribution byFlux(weights);
  if (byFlux.empty()) return {};
  const LightSampler sampler(t.settings.seed, SampleUse::indirectPhoton, frame.randomization,
                             static_cast<uint32_t>(k), log2Ceil(count), t.settings.randomization);
  for (uint32_t i = 0; i < static_cast<uint32_t>(count); ++i) {
    const Distribution::Choice choice = byFlux.choose(sampler.get1D(i, 0));
    const Vpl& vpl = *sources[choice.index];
    const LambertSource source{
        vpl.position, vpl.normal, vpl.error,
        kPi * t.shader.squaredIndex(vpl.media) / choice.probability * vpl.power};
    const Particle start = emitAimed(t, source, sampler.get2D(i, 2), sampler.get1D(i, 1));
    tracePhoton(t, start, vpl.media, vpl.diffuseCount, sampler, i, rays, out);
  }
  return PhotonGrid(std::move(out.photons), out.radius);
}

}  // namespace

void addCausticPhotons(const Transport& t, const FrameKey& frame, int k, LightSet& set) {
  const Settings& s = t.settings;
  if (s.caustics == Caustics::off || s.photons == 0 || !t.needs.specular() || t.emitters.empty())
    return;
  // The split does not depend on what this set's walks happened to find: that would bias both
  // halves. A single photon has no half: it becomes one of each.
  const bool all = s.caustics == Caustics::all && t.allows(2);
  const int fromVpls = all ? std::max(s.photons / 2, 1) : 0;
  set.photons = photonsFromEmitters(t, frame, k, std::max(s.photons - fromVpls, 1), set.rays);
  if (fromVpls == 0) return;
  std::vector<const Vpl*> sources;
  for (const Vpl& vpl : set.vpls)
    if (vpl.diffuseCount > 0) sources.push_back(&vpl);
  set.indirectPhotons = photonsFromVpls(t, frame, k, fromVpls, sources, set.rays);
}

Irradiance gatherPhotons(const Transport& t, const PhotonGrid& grid, Vec3 position, Vec3 n,
                         int pathVertices) {
  Flux sum(0);
  if (grid.empty()) return sum;
  grid.near(position, [&](const Photon& photon) {
    const bool counts = t.allows(photon.diffuseBefore + pathVertices);
    if (counts && glm::dot(photon.normal, n) > kPhotonNormalCosine) sum += photon.flux;
  });
  return sum / (kPi * grid.radius() * grid.radius());
}

}  // namespace ninefold
