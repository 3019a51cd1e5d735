// settings_check.h: settings that are each within range and yet too much together. Ranges of their
// own: settings_table.h.
//
// Candidates of a light set of a method with reverse VPLs, their worth for M camera points, and
// sums kept apart by path length take memory (gi/bidirectional):
//
//   n = r (direct + 2 indirect VPLs) <= 2^20,   n M <= 2^26,   path length <= 64, or 0 for no limit
//
// A rolling pool of photons is renewed in parts (gi/photon_map): as many a frame as divide it, and
// 65536 parts at most.
//
// Lines of an intersection field lie evenly if N directions and M distances have no common divisor
// (gi/intersection_field/line_grid.h).
//
// Light at the vertices of a finer mesh (gi/photon_map) takes memory by the scene's triangles,
// whatever the method, as a window may choose another one:
//
//   triangles 4^levels <= 2^23
//
// Threads: pure functions.   Errors: throws Error that says what is wrong and what would do.
#pragma once

#include "common/scene/scene.h"
#include "common/scene/settings.h"

namespace ninefold {

void checkTogether(const Settings& settings);
// What this scene is too large for.
void checkWith(const Scene& scene, const Settings& settings);

}  // namespace ninefold
