#include "common/gi/light_set/lamp_light.h"

#include "common/gi/vpl/direct_vpls.h"
#include "common/gi/vpl/indirect_vpls.h"

namespace ninefold {
namespace {

constexpr int kOriginPathsLog2 = 5;  // of photons that start at lit surfaces, for each set

}  // namespace

void addLampLight(const Transport& t, const FrameKey& frame, int k, LightSet& set,
                  const MinorLamps& leftOut) {
  if (t.emitters.empty()) return;
  addDirectVpls(t, frame, k, 1, set.vpls, leftOut);
  addCausticPhotons(t, frame, k, set);
}

void addCausticPhotons(const Transport& t, const FrameKey& frame, int k, LightSet& set) {
  if (t.emitters.empty()) return;
  VplSet origins;
  const Settings& s = t.settings;
  if (t.needs.caustics && s.caustics == Caustics::all && s.photons > 0 && t.allows(2))
    addIndirectVpls(t, frame, k, kOriginPathsLog2, origins, set.rays);
  set.photons = causticPhotons(t, frame, k, origins.vpls, s.caustics, s.photons, set.rays);
}

void gatherLampLight(const Transport& t, const LightSet& lights, const ReceiverSamples& samples,
                     int pathVertices, LightSetScratch& scratch, Receivers& receivers,
                     std::vector<Irradiance>* caustic, RayCounts& rays, const MinorLamps& leftOut) {
  gatherBounded(t, lights, samples, pathVertices, scratch, receivers, caustic, rays);
  if (t.settings.compensate)
    compensate(t, samples, pathVertices,
               {.emission = true, .onward = false, .glossy = false, .leftOut = &leftOut},
               scratch.compensation, receivers, rays, [](int, Receivers&) {});
}

}  // namespace ninefold
