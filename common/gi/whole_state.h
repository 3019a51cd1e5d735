// whole_state.h: a method's state made in this process, as the steps of frames at rest make it
// (master/running/state_plan.h): for tests, tools and the probe of the pixel class.
//
// Threads: pure functions.   Errors: as GiMethod::step.
#pragma once

#include "common/gi/renderer.h"
#include "common/scene/settings.h"

namespace ninefold {

// The pages that light frame `frame` of a run at rest, counted from 0, which is also its
// randomization; none for methods without a state. settings: those of the renderer. Adds the rays
// to `rays` if not null.
StatePages stateAtRest(const Renderer& renderer, const Settings& settings, uint32_t frame,
                       RayCounts* rays = nullptr);

// The same, ready to be asked; null for methods without a state.
std::shared_ptr<const MethodState> wholeState(const Renderer& renderer, const Settings& settings,
                                              uint32_t frame, RayCounts* rays = nullptr);

}  // namespace ninefold
