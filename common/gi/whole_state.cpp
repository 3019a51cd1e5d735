#include "common/gi/whole_state.h"

#include "common/scene/methods.h"

namespace ninefold {

StatePages stateAtRest(const Renderer& renderer, const Settings& settings, uint32_t frame,
                       RayCounts* rays) {
  StatePages pages;
  const StateFacts* facts = factsOf(settings.method).state;
  if (facts == nullptr) return pages;
  const uint32_t units = facts->unitsOfAll(settings);
  for (uint32_t i = facts->beginsAnew ? frame : 0; i <= frame; ++i) {
    const StatePages before = pages;
    StepKey step;
    step.firstUnit = i * units, step.randomization = i, step.units = units;
    for (uint32_t unit = 0; unit < units; ++unit) {
      const StepResult result = renderer.step(before, step, step.firstUnit + unit);
      pages.apply(result.deltas);
      if (rays != nullptr) *rays += result.rays;
    }
  }
  return pages;
}

std::shared_ptr<const MethodState> wholeState(const Renderer& renderer, const Settings& settings,
                                              uint32_t frame, RayCounts* rays) {
  if (factsOf(settings.method).state == nullptr) return nullptr;
  return renderer.digest(stateAtRest(renderer, settings, frame, rays));
}

}  // namespace ninefold
