#include "common/gi/selective/selective.h"

#include "common/gi/elements/element_light.h"
#include "common/gi/elements/photon_shooting.h"
#include "common/gi/elements/scene_stamp.h"
#include "common/gi/light_set/lamp_light.h"
#include "common/gi/selective/group_shooting.h"
#include "common/scene/methods.h"
#include "common/state/fixed_point.h"

namespace ninefold {
namespace {

// The VPLs stand on lamps alone.
struct SelectiveLight final : LightSet {
  const ElementLight* elements = nullptr;  // null: no photon. The state outlives the light.
};

// What tracing a row changes of the groups' priorities. Pilots that took another path than before
// add to groups that were not yet traced in the scene with this stamp; a group's own is spent.
std::vector<int64_t> priorityChanges(const PhotonGroups& groups, const StatePages& pages,
                                     uint32_t row, const std::optional<PhotonRow>& before,
                                     const PhotonRow& now) {
  const GroupPages rows(groups);
  std::vector<int64_t> changes(groups.groups(), 0);
  if (!groups.hasPilots(row)) changes[row] = -GroupPages::priority(pages, row);
  if (!before) return changes;
  const size_t count = std::min(before->pilots.size(), now.pilots.size());
  for (uint32_t k = 0; k < count; ++k) {
    const Pilot &was = before->pilots[k], &is = now.pilots[k];
    const uint32_t group = groups.likeGroup(groups.photon(row, k));
    const auto header = rows.header(pages, group);
    const bool isStale = !header || header->stamp != now.stamp;
    if (was.signature != is.signature && isStale)
      changes[group] += toFixed(double{std::max(was.weight, is.weight)}, kWeightQuantum);
  }
  return changes;
}

std::shared_ptr<KeptPaths> keptPaths(const Settings& settings, const PhotonGroups& groups,
                                     const std::shared_ptr<KeptPaths>& before) {
  const bool areKept = factsOf(settings.method).state->remembers(settings);
  if (before != nullptr || !areKept) return before;
  return std::make_shared<KeptPaths>(groups.rows());
}

}  // namespace

Selective::Selective(const Transport& transport, const Selective* begun, const Selective* before)
    : LayeredMethod(transport),
      groups_(transport.settings),
      surfaces_(std::make_shared<const SurfaceNumbers>(transport.scene)),
      minor_(transport.emitters, transport.settings.minorLamps,
             begun != nullptr ? &begun->minor_ : nullptr),
      stamp_(sceneStamp(transport, minor_)),
      lampFlux_(fluxOfLamps(transport)),
      masking_(begun != nullptr
                   ? begun->masking_
                   : std::make_shared<const VisualMasking>(
                         transport.scene, transport.settings.elementSize * transport.radius,
                         before != nullptr ? before->masking_.get() : nullptr)),
      still_(transport.tracer, begun != nullptr ? &begun->t_.scene : nullptr),
      order_(transport.tracer, groups_, *surfaces_, stamp_),
      world_(std::make_shared<const PathWorld>(transport, minor_)),
      kept_(keptPaths(transport.settings, groups_,
                      before != nullptr && before->groups_ == groups_ ? before->kept_ : nullptr)) {}

std::shared_ptr<const FrameLight> Selective::light(const FrameKey& frame, int set,
                                                   std::span<const View>,
                                                   const MethodState* state) const {
  auto light = std::make_shared<SelectiveLight>();
  light->elements = static_cast<const ElementLight*>(state);
  addLampLight(t_, frame, set, *light, minor_);
  return light;
}

std::unique_ptr<Scratch> Selective::makeScratch() const {
  return std::make_unique<LampLightScratch>();
}

StepResult Selective::step(const StatePages& pages, const StepKey& step, uint32_t unit,
                           const View& view) const {
  const GroupPages rows(groups_);
  const uint32_t row = order_.rowOf(pages, view, step, unit);
  const std::optional<PhotonRow> before = rows.read(pages, row);
  const uint32_t randomization = before ? before->randomization : step.randomization;
  StepResult result;
  const GroupShooting shooting{t_,     groups_,   *surfaces_,  *masking_, minor_,
                               stamp_, lampFlux_, rows.room(), world_,    kept_.get()};
  const PhotonRow now = shooting.shoot(row, randomization, step.to, result.rays);
  result.deltas = rows.replace(pages, row, now);
  GroupPages::addPriorities(priorityChanges(groups_, pages, row, before, now), result.deltas);
  return result;
}

std::shared_ptr<const MethodState> Selective::digest(const StatePages& pages,
                                                     const MethodState* before) const {
  const auto* earlier = static_cast<const ElementLight*>(before);
  auto elements = sceneElements(still_, t_.settings.elementSize * t_.radius,
                                earlier == nullptr ? nullptr : earlier->elements());
  return std::make_shared<const ElementLight>(still_.tracer(), pages, GroupPages(groups_),
                                              surfaces_, std::move(elements),
                                              t_.settings.elementRule, earlier);
}

void Selective::query(const FrameLight& frameLight, const ReceiverSamples& samples,
                      int pathVertices, LayeredScratch& memory, Receivers& receivers,
                      std::vector<Irradiance>* caustic, RayCounts& rays) const {
  const auto& light = static_cast<const SelectiveLight&>(frameLight);
  auto& scratch = static_cast<LampLightScratch&>(memory);
  gatherLampLight(t_, light, samples, pathVertices, scratch.lamps, receivers, caustic, rays,
                  minor_);
  if (light.elements != nullptr) light.elements->addTo(still_.tracer(), receivers);
}

}  // namespace ninefold
