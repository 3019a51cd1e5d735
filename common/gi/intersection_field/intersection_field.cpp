#include "common/gi/intersection_field/intersection_field.h"

#include <algorithm>

#include "common/gi/elements/photon_shooting.h"
#include "common/gi/elements/scene_stamp.h"
#include "common/gi/intersection_field/field_size.h"
#include "common/gi/light_set/lamp_light.h"
#include "common/scene/methods.h"

namespace ninefold {
namespace {

// The VPLs stand on lamps alone.
struct FieldLight final : LightSet {
  const ElementLight* elements = nullptr;  // null: no photon. The state outlives the light.
};

bool lightsDirectly(const Settings& settings) {
  return settings.fieldDirect == FieldDirect::field && settings.directVpls > 0;
}

// The grid around `held`, once its lines are known to have room.
LineGrid checkedGrid(const Transport& t, const Scene& held, const SceneElements& elements,
                     const LineField* before) {
  const Bounds box = coverBox(held);
  const LineGrid grid(box, t.settings.fieldDirections, t.settings.fieldDistances);
  const size_t lamps = lightsDirectly(t.settings) ? areaLamps(t).size() : 0;
  checkFieldSize(grid, {t.scene, box, elements, lamps, before}, t.settings);
  return grid;
}

}  // namespace

IntersectionField::IntersectionField(const Transport& transport, const IntersectionField* begun,
                                     const IntersectionField* before)
    : IntersectionField(transport, begun, knownOf(begun, before)) {}

// In a gesture lines go on from its beginning, elements from its latest frame.
IntersectionField::Known IntersectionField::knownOf(const IntersectionField* begun,
                                                    const IntersectionField* before) {
  if (begun == nullptr) return {before, before};
  const bool goesOn = before != nullptr && before->still_.begun() == &begun->t_.scene;
  return {begun, goesOn ? before : begun};
}

IntersectionField::IntersectionField(const Transport& transport, const IntersectionField* begun,
                                     const Known& known)
    : LayeredMethod(transport),
      rows_(fieldRows(transport.settings), kPhotonsOfRow),
      surfaces_(std::make_shared<const SurfaceNumbers>(transport.scene)),
      stamp_(sceneStamp(transport, {})),
      lampFlux_(fluxOfLamps(transport)),
      order_(rows_, stamp_),
      still_(transport.tracer, begun != nullptr ? &begun->t_.scene : nullptr),
      elements_(sceneElements(still_, transport.settings.elementSize * transport.radius,
                              known.elements == nullptr ? nullptr : known.elements->elements_)),
      field_(checkedGrid(transport, begun != nullptr ? begun->t_.scene : transport.scene,
                         *elements_, known.lines == nullptr ? nullptr : &known.lines->field_),
             transport.scene, known.lines == nullptr ? nullptr : &known.lines->field_),
      lines_(field_, transport.scene, *elements_,
             known.lines == nullptr ? nullptr : &known.lines->field_,
             known.lines == nullptr ? nullptr : known.lines->elements_.get(),
             known.lines == nullptr ? nullptr : &known.lines->lines_),
      lamps_(lightsDirectly(transport.settings)
                 ? std::make_unique<const LampVisibility>(
                       transport, field_, *elements_,
                       known.lines == nullptr ? nullptr : known.lines->lamps_.get())
                 : nullptr) {}

size_t IntersectionField::bytes() const {
  return field_.bytes() + lines_.bytes() + (lamps_ == nullptr ? 0 : lamps_->bytes());
}

std::shared_ptr<const FrameLight> IntersectionField::light(const FrameKey& frame, int set,
                                                           std::span<const View>,
                                                           const MethodState* state) const {
  auto light = std::make_shared<FieldLight>();
  light->elements = static_cast<const ElementLight*>(state);
  addLampLight(t_, frame, set, *light);
  if (lamps_ != nullptr) std::erase_if(light->vpls, [](const Vpl& vpl) { return vpl.emits; });
  return light;
}

std::unique_ptr<Scratch> IntersectionField::makeScratch() const {
  return std::make_unique<LampLightScratch>();
}

StepResult IntersectionField::step(const StatePages& pages, const StepKey& step, uint32_t unit,
                                   const View&) const {
  const uint32_t row = order_.rowAt(pages, unit - step.firstUnit);
  const auto before = rows_.header(pages, row);
  const uint32_t randomization = before ? before->randomization : step.randomization;
  StepResult result;
  result.deltas = rows_.replace(pages, row, shoot(row, randomization, step.to, result.rays));
  return result;
}

PhotonRow IntersectionField::shoot(uint32_t row, uint32_t randomization, uint32_t version,
                                   RayCounts& rays) const {
  PhotonRow left{stamp_, randomization, version, lampFlux_, {}, {}};
  if (t_.emitters.empty()) return left;
  const auto photons = static_cast<uint32_t>(t_.settings.fieldPhotons);
  const float share = 1 / static_cast<float>(photons);
  const LineWalk walk{t_.tracer, field_, *elements_, lines_};
  const auto leave = [&](const ShadingPoint& p, Vec2 u) { return walk.leave(p, u, rays); };
  const auto gain = [&](const Arrival& a) { return a.known ? walk.gain(*a.point) : 1.0f; };
  const auto streams = photonStreams(t_, SampleUse::fieldPhoton, randomization);
  const uint32_t end = std::min((row + 1) * kPhotonsOfRow, photons);
  for (uint32_t photon = row * kPhotonsOfRow; photon < end; ++photon)
    for (const PhotonStream& stream : streams)
      shootPhoton(t_, *surfaces_, photonStart(t_, {}, stream, photon), stream, photon, share,
                  left.hits, rays, leave, gain);
  if (left.hits.size() > rows_.room())
    thinHits(left, rows_.room(), hashWords(t_.settings.seed, randomization, row));
  return left;
}

std::shared_ptr<const MethodState> IntersectionField::digest(const StatePages& pages,
                                                             const MethodState* before) const {
  return std::make_shared<const ElementLight>(still_.tracer(), pages, rows_, surfaces_, elements_,
                                              t_.settings.elementRule,
                                              static_cast<const ElementLight*>(before));
}

void IntersectionField::query(const FrameLight& frameLight, const ReceiverSamples& samples,
                              int pathVertices, LayeredScratch& memory, Receivers& receivers,
                              std::vector<Irradiance>* caustic, RayCounts& rays) const {
  const auto& light = static_cast<const FieldLight&>(frameLight);
  auto& scratch = static_cast<LampLightScratch&>(memory);
  if (lamps_ != nullptr) {
    gatherBounded(t_, light, samples, pathVertices, scratch.lamps, receivers, caustic, rays);
    lamps_->gather(samples, pathVertices, receivers, rays);
  } else {
    gatherLampLight(t_, light, samples, pathVertices, scratch.lamps, receivers, caustic, rays);
  }
  if (light.elements != nullptr) light.elements->addTo(still_.tracer(), receivers);
}

}  // namespace ninefold
