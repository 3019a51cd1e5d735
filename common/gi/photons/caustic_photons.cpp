#include "common/gi/photons/caustic_photons.h"

#include "common/gi/light/light_path.h"
#include "common/gi/photons/photon_footprint.h"
#include "common/gi/photons/photon_spread.h"

namespace ninefold {
namespace {

constexpr uint32_t kTurnDimension = 7;  // the padded group before has room
constexpr uint32_t kWalkDimension = 8;  // after the joint four of the start and one padded group
constexpr uint32_t kPilot = 1024;       // photons of a stream that tell how its lamps' light lies

// A photon at the first D vertex after an S vertex. flux: what it adds to E there, times area.
struct Landed {
  ShadingPoint point;
  Flux flux{0};
  int diffuseBefore = 0;
  float turn = 0;  // of its footprint
};

PhotonSpread::Landing landingOf(const Landed& photon, uint32_t lamp) {
  return {photon.point.surface.position, photon.point.ng, maxComponent(photon.flux), lamp};
}

// Where photons come to lie.
struct Deposit {
  const Transport& t;
  const PhotonRadii& radii;
  SortedPhotons& photons;
  RayCounts& rays;

  void add(const Landed& photon, size_t kind) {
    const float footprint = photonFootprint(t, photon.point, radii.radius(kind), photon.turn, rays);
    photons[kind].push_back({photon.point.surface.position, photon.point.ng,
                             photon.flux / footprint, photon.diffuseBefore});
  }
  // As narrow as the pattern of its lamp's photons asks for.
  void add(const Landed& photon, uint32_t lamp, const PhotonSpread& spread) {
    size_t kind = radii.choose(photon.flux);
    const PhotonSpread::Landing landing = landingOf(photon, lamp);
    for (size_t i = 0; i < kPhotonHalvings && spread.isUneven(landing, radii.first(kind)); ++i)
      --kind;
    add(photon, kind);
  }
};

// Follows a photon through S vertices and calls land(Landed) at the first D vertex if it was
// focused on it. share: 1/number of photons sent out.
template <typename Land>
void tracePhoton(const Transport& t, const Particle& start, const MediumStack& media,
                 int diffuseBefore, const LightSampler& sampler, uint32_t i, float share,
                 RayCounts& rays, Land&& land) {
  walkLightPath(
      t, start, media, diffuseBefore, sampler, i, kWalkDimension, rays, [&](const Arrival& a) {
        const ShadingPoint& p = *a.point;
        if (!a.focused || isBlack(p.bsdf.diffuse)) return false;
        const Flux flux =
            share / t.shader.squaredIndex(a.media) * shadingFactor(p, p.ns, p.wo) * a.flux;
        if (!isBlack(flux))
          land(Landed{p, flux, a.diffuseBefore, sampler.get1D(i, kTurnDimension)});
        return false;  // what scatters diffusely here is the VPLs' part
      });
}

void photonsFromEmitters(const Transport& t, size_t stream, const FrameKey& frame, int k,
                         int countOfFirst, Deposit& out) {
  const auto count = static_cast<uint32_t>(t.streams.samples(stream, countOfFirst));
  const LightSampler sampler(LightStreams::seedOf(stream, t.settings.seed), SampleUse::photon,
                             frame.randomization, static_cast<uint32_t>(k),
                             log2Ceil(static_cast<int>(count)), t.settings.randomization);
  const auto trace = [&](uint32_t i, const auto& land) {
    const Particle start =
        emitAimed(t, stream, sampler.get2D(i, 0), sampler.get2D(i, 2), sampler.get1D(i, 4));
    tracePhoton(t, start, {}, 0, sampler, i, 1 / static_cast<float>(count), out.rays,
                [&](const Landed& photon) { land(photon, start.lamp); });
  };
  const uint32_t pilots = std::min(count, kPilot);
  std::vector<std::pair<Landed, uint32_t>> first;
  PhotonSpread spread;
  for (uint32_t i = 0; i < pilots; ++i)
    trace(i, [&](const Landed& photon, uint32_t lamp) {
      spread.add(landingOf(photon, lamp));
      first.emplace_back(photon, lamp);
    });
  for (const auto& [photon, lamp] : first) out.add(photon, lamp, spread);
  for (uint32_t i = pilots; i < count; ++i)
    trace(i, [&](const Landed& photon, uint32_t lamp) { out.add(photon, lamp, spread); });
}

void photonsFromVpls(const Transport& t, const FrameKey& frame, int k, int count,
                     const std::vector<const Vpl*>& sources, Deposit& out) {
  std::vector<double> flux;
  flux.reserve(sources.size());
  for (const Vpl* vpl : sources) flux.push_back(static_cast<double>(maxComponent(vpl->power)));
  const std::vector<double> shares = partlyAlike(flux);
  const Distribution byFlux(std::vector<float>(shares.begin(), shares.end()));
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
    tracePhoton(t, start, vpl.media, vpl.diffuseCount, sampler, i, 1 / static_cast<float>(count),
                out.rays,
                [&](const Landed& photon) { out.add(photon, out.radii.choose(photon.flux)); });
  }
}

// Flux within r of sixteen receivers, planar.
struct PacketFlux {
  float r[kPacket]{}, g[kPacket]{}, b[kPacket]{};
};

// Adds a photon to the lanes of the receivers that accept it.
void addPhoton(const Photon& photon, Metres r, const Receivers& x, size_t first, size_t count,
               PacketFlux& sum, size_t lane) {
  const float r2 = r * r, height = kPhotonHeight * r;
#pragma GCC ivdep
  for (size_t i = 0; i < count; ++i) {
    const float dx = photon.position.x - x.px[first + i], dy = photon.position.y - x.py[first + i],
                dz = photon.position.z - x.pz[first + i];
    const float cosine = photon.normal.x * x.gx[first + i] + photon.normal.y * x.gy[first + i] +
                         photon.normal.z * x.gz[first + i];
    const float off = dx * photon.normal.x + dy * photon.normal.y + dz * photon.normal.z;
    const bool near = (dx * dx + dy * dy + dz * dz <= r2) & (std::abs(off) <= height);
    const float one = near & (cosine > kPhotonNormalCosine) ? 1.0f : 0.0f;
    sum.r[lane + i] += one * photon.flux.x;
    sum.g[lane + i] += one * photon.flux.y;
    sum.b[lane + i] += one * photon.flux.z;
  }
}

// One query for all of them if they lie together, else one for each half.
void addFlux(const Transport& t, const PhotonGrid& grid, const Receivers& x, size_t first,
             size_t count, int pathVertices, PacketFlux& sum, size_t lane) {
  Vec3 low = x.position(first), high = low;
  for (size_t i = 1; i < count; ++i) {
    low = glm::min(low, x.position(first + i));
    high = glm::max(high, x.position(first + i));
  }
  const bool done = grid.near(low, high, [&](const Photon& photon) {
    if (t.allows(photon.diffuseBefore + pathVertices))
      addPhoton(photon, grid.radius(), x, first, count, sum, lane);
  });
  if (done) return;
  const size_t half = count / 2;
  addFlux(t, grid, x, first, half, pathVertices, sum, lane);
  addFlux(t, grid, x, first + half, count - half, pathVertices, sum, lane + half);
}

}  // namespace

CausticPhotons causticPhotons(const Transport& t, const FrameKey& frame, int k,
                              std::span<const Vpl> vpls, Caustics which, int count,
                              RayCounts& rays) {
  if (which == Caustics::off || count == 0 || !t.needs.caustics || t.emitters.empty()) return {};
  // The split does not depend on what this set's walks happened to find: that would bias both
  // halves. A single photon has no half: it becomes one of each.
  const bool all = which == Caustics::all && t.allows(2);
  const int fromVpls = all ? std::max(count / 2, 1) : 0;
  const PhotonRadii radii(t, frame.photonRadius);
  SortedPhotons photons;
  Deposit deposit{t, radii, photons, rays};
  for (size_t stream = 0; stream < t.streams.count(); ++stream)
    photonsFromEmitters(t, stream, frame, k, std::max(count - fromVpls, 1), deposit);
  if (fromVpls > 0) {
    std::vector<const Vpl*> sources;
    for (const Vpl& vpl : vpls)
      if (vpl.diffuseCount > 0 && !isBlack(vpl.power)) sources.push_back(&vpl);
    photonsFromVpls(t, frame, k, fromVpls, sources, deposit);
  }
  CausticPhotons grids;
  for (size_t kind = 0; kind < kPhotonKinds; ++kind)
    grids[kind] = PhotonGrid(std::move(photons[kind]), radii.radius(kind));
  return grids;
}

void gatherPhotons(const Transport& t, const PhotonGrid& grid, int pathVertices,
                   Receivers& receivers, std::vector<Irradiance>* caustic) {
  if (grid.empty()) return;
  const float scale = 1 / (kPi * grid.radius() * grid.radius());
  for (size_t first = 0; first < receivers.size(); first += kPacket) {
    PacketFlux sum;
    const size_t count = std::min<size_t>(kPacket, receivers.size() - first);
    addFlux(t, grid, receivers, first, count, pathVertices, sum, 0);
    for (size_t lane = 0; lane < count; ++lane) {
      const Irradiance e = scale * Vec3(sum.r[lane], sum.g[lane], sum.b[lane]);
      receivers.addIrradiance(first + lane, e);
      if (caustic != nullptr) (*caustic)[first + lane] += e;
    }
  }
}

}  // namespace ninefold
