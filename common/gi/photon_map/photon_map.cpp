#include "common/gi/photon_map/photon_map.h"

#include "common/gi/photon_map/map_gather.h"
#include "common/gi/photon_map/shooting.h"
#include "common/gi/vpl/direct_vpls.h"
#include "common/gi/vpl/indirect_vpls.h"

namespace ninefold {
namespace {

constexpr int kOriginPathsLog2 = 5;  // of photons that start at lit surfaces, for each set

struct MapState final : MethodState {
  std::shared_ptr<const PhotonPool> pool;
};

// The VPLs stand on lamps alone.
struct MapLight final : LightSet {
  std::shared_ptr<const PhotonPool> pool;  // null: no photon
  uint32_t randomization = 0;
};

struct MapScratch final : LayeredScratch {
  LightSetScratch gather;
  MapGatherScratch map;
};

// Caustic photons of a set.
CausticPhotons causticsOf(const Transport& t, const FrameKey& frame, int set, RayCounts& rays) {
  VplSet origins;
  const Settings& s = t.settings;
  if (t.needs.caustics && s.caustics == Caustics::all && s.photons > 0 && t.allows(2))
    addIndirectVpls(t, frame, set, kOriginPathsLog2, origins, rays);
  return causticPhotons(t, frame, set, origins.vpls, s.caustics, s.photons, rays);
}

}  // namespace

std::shared_ptr<const FrameLight> PhotonMap::light(const FrameKey& frame, int set,
                                                   std::span<const View>,
                                                   const MethodState* state) const {
  auto light = std::make_shared<MapLight>();
  light->randomization = frame.randomization;
  if (state != nullptr) light->pool = static_cast<const MapState*>(state)->pool;
  if (t_.emitters.empty()) return light;
  if (t_.settings.mapDirect == MapDirect::off) addDirectVpls(t_, frame, set, 1, light->vpls);
  light->photons = causticsOf(t_, frame, set, light->rays);
  return light;
}

std::unique_ptr<Scratch> PhotonMap::makeScratch() const { return std::make_unique<MapScratch>(); }

StepResult PhotonMap::step(const StatePages& pages, const StepKey& step, uint32_t unit,
                           const View&) const {
  const MapLayout layout(t_.settings);
  StepResult result;
  const auto photons = shootUnit(t_, step.randomization, unit, layout, result.rays);
  result.deltas = layout.replace(pages, layout.partOf(unit), photons);
  return result;
}

std::shared_ptr<const MethodState> PhotonMap::digest(const StatePages& pages,
                                                     const MethodState*) const {
  auto state = std::make_shared<MapState>();
  state->pool = std::make_shared<const PhotonPool>(readPhotons(pages), t_.settings.mapIndex);
  return state;
}

void PhotonMap::query(const FrameLight& frameLight, const ReceiverSamples& samples,
                      int pathVertices, LayeredScratch& memory, Receivers& receivers,
                      std::vector<Irradiance>* caustic, RayCounts& rays) const {
  const auto& light = static_cast<const MapLight&>(frameLight);
  auto& scratch = static_cast<MapScratch&>(memory);
  receivers.pad();
  gatherVpls(t_, light, samples, pathVertices, t_.settings.vplRoulette, scratch.gather.vplGather,
             receivers, rays.shadow);
  for (const PhotonGrid& grid : light.photons)
    gatherPhotons(t_, grid, pathVertices, receivers, caustic);
  if (t_.settings.compensate && t_.settings.mapDirect == MapDirect::off)
    compensate(t_, samples, pathVertices, {.emission = true, .onward = false, .glossy = false},
               scratch.gather.compensation, receivers, rays, [](int, Receivers&) {});
  if (light.pool != nullptr)
    gatherPool(t_, *light.pool, pathVertices, light.randomization, scratch.map, receivers, rays);
}

}  // namespace ninefold
