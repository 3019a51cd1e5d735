#include "common/gi/whole_state.h"

#include "common/scene/methods.h"

namespace ninefold {

std::shared_ptr<const MethodState> wholeState(const Renderer& renderer, const Settings& settings,
                                              uint32_t randomization, RayCounts* rays) {
  const StateFacts* facts = factsOf(settings.method).state;
  if (facts == nullptr) return nullptr;
  StepKey key;
  key.randomization = randomization;
  StatePages before, pages;
  const uint32_t units = facts->unitsOfAll(settings);
  for (uint32_t unit = 0; unit < units; ++unit) {
    const StepResult result = renderer.step(before, key, unit);
    pages.apply(result.deltas);
    if (rays != nullptr) *rays += result.rays;
  }
  return renderer.digest(pages);
}

}  // namespace ninefold
