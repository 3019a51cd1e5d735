// light_check.h: light that is no number (infinite, NaN) is a mistake of ours, found where it was
// made: in builds without NDEBUG the renderer asks these after each light set and each task.
//
// In all builds the wire counts such values, replaces them by 0 and warns (proto/tile_codec.h).
// Threads: pure.   Errors: aborts with the values and the command that makes them again.
#pragma once

#include "common/gi/method/method.h"
#include "common/scene/scene.h"

namespace ninefold {

void checkLight(const TileResult& tile, const Task& task, const Scene& scene,
                const Settings& settings);
void checkLight(const FrameLight& light, const FrameKey& frame, int set, const Scene& scene,
                const Settings& settings);

}  // namespace ninefold
