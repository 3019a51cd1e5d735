// whole_state.h: a method's state made in this process, all of it by one step from the empty state:
// for tests, tools and the probe of the pixel class.
//
// Threads: pure function.   Errors: none.
#pragma once

#include "common/gi/renderer.h"
#include "common/scene/settings.h"

namespace ninefold {

// The state of a frame with this randomization index, as it is at rest. Null for methods without
// one. settings: those of the renderer. Adds the rays to `rays` if not null.
std::shared_ptr<const MethodState> wholeState(const Renderer& renderer, const Settings& settings,
                                              uint32_t randomization, RayCounts* rays = nullptr);

}  // namespace ninefold
