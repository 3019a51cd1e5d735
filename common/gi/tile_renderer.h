// tile_renderer.h: one task: eye paths of a tile's pixels of one phase, then irradiance from one
// light set.
//
//   1. first hits (first_hits.h), split into layers
//   2. VPLs and photons gathered for all receivers of a layer together
//
// The reference method goes its own way from the first hits on, see reference_task.h.
// Threads: reentrant with one Scratch a thread.   Errors: none.
#pragma once

#include "common/gi/task_context.h"

namespace ninefold {

void renderTask(const Transport& transport, const View& view, const Task& task,
                const LightSet& lights, Scratch& scratch, TileResult& out);

}  // namespace ninefold
