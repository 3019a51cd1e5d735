// whole_state.h: a method's state made in one process, as the steps of frames at rest make it.
//
// Threads: pure functions.   Errors: as GiMethod::step.
#pragma once

#include "common/gi/renderer.h"
#include "common/scene/methods.h"

namespace ninefold {

// The pages that a step of all units makes of nothing. None for methods without a state.
inline StatePages wholeState(const Renderer& renderer, const Settings& settings,
                             uint32_t randomization) {
  StatePages pages;
  const StateFacts* facts = factsOf(settings.method).state;
  if (facts == nullptr) return pages;
  StepKey step;
  const uint32_t units = facts->unitsOfAll(settings);
  step.firstUnit = randomization * units, step.randomization = randomization;
  const StatePages nothing;
  for (uint32_t unit = 0; unit < units; ++unit)
    pages.apply(renderer.step(nothing, step, step.firstUnit + unit).deltas);
  return pages;
}

}  // namespace ninefold
