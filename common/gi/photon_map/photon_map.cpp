#include "common/gi/photon_map/photon_map.h"

#include <mutex>

#include "common/gi/light_set/lamp_light.h"
#include "common/gi/photon_map/shooting.h"
#include "common/gi/photon_map/vertex_gather.h"
#include "common/scene/settings_check.h"

namespace ninefold {
namespace {

struct MapState final : MethodState {
  std::shared_ptr<const PhotonPool> pool;

  // Light at vertices, which all frames of this version and randomization share. At rest a version
  // has one frame, and in motion randomizations stay: one table is enough.
  std::shared_ptr<VertexLight> lightAtVertices(size_t entries, uint32_t randomization) const {
    const std::lock_guard lock(mutex_);
    if (vertices_ == nullptr || randomization_ != randomization)
      vertices_ = std::make_shared<VertexLight>(entries), randomization_ = randomization;
    return vertices_;
  }

 private:
  mutable std::mutex mutex_;
  mutable std::shared_ptr<VertexLight> vertices_;  // guarded by mutex_, as is the next
  mutable uint32_t randomization_ = 0;
};

// The VPLs stand on lamps alone.
struct MapLight final : LightSet {
  std::shared_ptr<const PhotonPool> pool;  // null: no photon
  uint32_t randomization = 0;
  std::shared_ptr<VertexLight> vertices;  // null: E is found at pixels, or there is no pool
};

struct MapScratch final : LampLightScratch {
  MapGatherScratch map;
  VertexGatherScratch vertices;
};

}  // namespace

PhotonMap::PhotonMap(const Transport& transport, const PhotonMap* begun)
    : LayeredMethod(transport), world_(t_, begun != nullptr ? &begun->world_ : nullptr) {
  checkWith(t_.scene, t_.settings);
  if (t_.settings.mapEstimate == MapEstimate::vertices)
    vertices_ = std::make_unique<const MapVertices>(t_);
}

std::shared_ptr<const FrameLight> PhotonMap::light(const FrameKey& frame, int set,
                                                   std::span<const View>,
                                                   const MethodState* state) const {
  auto light = std::make_shared<MapLight>();
  light->randomization = frame.randomization;
  if (const auto* map = static_cast<const MapState*>(state)) {
    light->pool = map->pool;
    if (vertices_)
      light->vertices = map->lightAtVertices(vertices_->entries(), frame.randomization);
  }
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
  const auto photons = shootUnit(world_.transport(), step.randomization, unit, layout, result.rays);
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
  if (light.pool == nullptr) return;
  if (light.vertices != nullptr && pathVertices == 1)
    gatherAtVertices(t_, *light.pool, *vertices_, *light.vertices, light.randomization, scratch.map,
                     scratch.vertices, receivers, rays);
  else
    gatherPool(t_, *light.pool, pathVertices, light.randomization, scratch.map, receivers, rays);
}

}  // namespace ninefold
