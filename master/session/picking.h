// picking.h: what lies at a place of a shown picture. A picture at rest knows; one in motion knows
// if LiveRun::wantPicks asked for it. One that does not know gives nothing.
//
// Film positions count pixels of the shown image from its upper left corner.
// Threads: pure functions.   Errors: none.
#pragma once

#include <optional>
#include <vector>

#include "master/running/live_run.h"
#include "master/session/panel_values.h"

namespace ninefold {

// The instance seen at a film position; none where nothing was hit. Needs shown.image->picks.
std::optional<uint32_t> instanceAt(const Shown& shown, Vec2 film);

// The first hit there, in world space [m].
std::optional<Vec3> pointAt(const Shown& shown, Vec2 film);

// Draws into rgb, the shown image's bytes, where the selected thing's pixels end.
void drawOutline(const Shown& shown, const Scene& scene, const Selection& selection,
                 std::vector<uint8_t>& rgb);

// Of all instances of a node, each moved by `motion`.
Bounds boundsOfNode(const Scene& scene, int node, const DMat4& motion = DMat4(1));

}  // namespace ninefold
