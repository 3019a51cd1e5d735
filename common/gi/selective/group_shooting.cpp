#include "common/gi/selective/group_shooting.h"

#include <cmath>

#include "common/gi/elements/packed_flux.h"
#include "common/gi/elements/photon_shooting.h"
#include "common/gi/selective/path_replay.h"

namespace ninefold {
namespace {

constexpr double kMostWeight = 100;

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

PhotonRow GroupShooting::shoot(uint32_t row, uint32_t randomization, uint32_t version,
                               RayCounts& rays) const {
  const Transport& t = transport;
  PhotonRow left{stamp, randomization, version, lampFlux, {}, {}};
  if (t.emitters.empty()) return left;
  const double meanFlux = double{lampFlux} / groups.photons();
  const float share = 1 / static_cast<float>(groups.photons());
  const std::vector<PhotonStream> streams = photonStreams(t, SampleUse::groupPhoton, randomization);
  PathReplay replay(kept == nullptr ? nullptr : kept->find(row, randomization), world,
                    randomization, !t.solidBounds.empty());
  const auto trace = [&](const Tracer& tracer, Vec3 origin, Vec3 direction) {
    return replay.trace(tracer, origin, direction);
  };
  for (uint32_t k = 0; k < groups.photonsOf(row); ++k) {
    const size_t first = left.hits.size();
    const uint32_t photon = groups.photon(row, k);
    for (const PhotonStream& stream : streams) {
      const auto start = [&] { return photonStart(t, minor, stream, photon); };
      if (replay.takeOver(start, left.hits)) continue;
      const PhotonStart begin = start();
      replay.begin(begin);
      shootPhoton(
          t, surfaces, begin, stream, photon, share, left.hits, rays, cosineWay,
          [](const Arrival&) { return 1.0f; }, trace);
      replay.end(left.hits);
    }
    if (groups.hasPilots(row)) left.pilots.push_back(pilotOf(left.hits, first, meanFlux));
  }
  if (kept != nullptr) kept->put(row, replay.finish(left.hits));
  if (left.hits.size() > room) thinHits(left, room, hashWords(t.settings.seed, randomization, row));
  return left;
}

}  // namespace ninefold
