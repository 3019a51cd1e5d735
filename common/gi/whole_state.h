// whole_state.h: a method's state made in one process, as the steps of frames at rest make it
// (master/running/state_plan.h).
//
// Threads: pure function.   Errors: as GiMethod::step.
#pragma once

#include "common/gi/renderer.h"
#include "common/scene/methods.h"

namespace ninefold {

// The pages that light frame `frame` of a run at rest, counted from 0; none without a state.
inline StatePages stateAtRest(const Renderer& renderer, const Settings& settings, uint32_t frame) {
  StatePages pages;
  const StateFacts* facts = factsOf(settings.method).state;
  if (facts == nullptr) return pages;
  const uint32_t units = facts->unitsOfAll(settings);
  for (uint32_t i = facts->beginsAnew ? frame : 0; i <= frame; ++i) {
    const StatePages before = pages;
    const StepKey step{.firstUnit = i * units, .randomization = i};
    for (uint32_t unit = 0; unit < units; ++unit)
      pages.apply(renderer.step(before, step, step.firstUnit + unit).deltas);
  }
  return pages;
}

}  // namespace ninefold
