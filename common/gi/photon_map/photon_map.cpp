#include "common/gi/photon_map/photon_map.h"

#include "common/gi/light_set/lamp_light.h"
#include "common/gi/photon_map/map_gather.h"
#include "common/gi/photon_map/shooting.h"

namespace ninefold {
namespace {

struct MapState final : MethodState {
  std::shared_ptr<const PhotonPool> pool;
};

// The VPLs stand on lamps alone.
struct MapLight final : LightSet {
  std::shared_ptr<const PhotonPool> pool;  // null: no photon
  uint32_t randomization = 0;
};

struct MapScratch final : LampLightScratch {
  MapGatherScratch map;
};

}  // namespace

std::shared_ptr<const FrameLight> PhotonMap::light(const FrameKey& frame, int set,
                                                   std::span<const View>,
                                                   const MethodState* state) const {
  auto light = std::make_shared<MapLight>();
  light->randomization = frame.randomization;
  if (state != nullptr) light->pool = static_cast<const MapState*>(state)->pool;
  if (t_.settings.mapDirect == MapDirect::off)
    addLampLight(t_, frame, set, *light);
  else
    addCausticPhotons(t_, frame, set, *light);
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
  if (t_.settings.mapDirect == MapDirect::off) {
    gatherLampLight(t_, light, samples, pathVertices, scratch.lamps, receivers, caustic, rays);
  } else {
    receivers.pad();
    for (const PhotonGrid& grid : light.photons)
      gatherPhotons(t_, grid, pathVertices, receivers, caustic);
  }
  if (light.pool != nullptr)
    gatherPool(t_, *light.pool, pathVertices, light.randomization, scratch.map, receivers, rays);
}

}  // namespace ninefold
