// picking.h: what a shown frame says of a place in it. A frame carries objects and depth when they were
// asked for (LiveRun::wantObjects); one without them says nothing.
//
// Film positions count pixels of the shown image from its upper left corner. Threads: pure functions.
// Errors:  none.
#pragma once

#include <optional>
#include <vector>

#include "master/live_run.h"
#include "master/window/panel.h"

namespace ninefold {

// The instance seen at a film position; none where nothing was hit. shown.image->objects is not empty.
std::optional<uint32_t> instanceAt(const Shown& shown, Vec2 film);

// The first hit there, in world space [m].
std::optional<Vec3> pointAt(const Shown& shown, Vec2 film);

// Draws into rgb, the shown image's bytes, where the selected thing's pixels end.
void drawOutline(const Shown& shown, const Scene& scene, const Selection& selection,
                 std::vector<uint8_t>& rgb);

// Of all instances of a node, each moved by `motion`.
Bounds boundsOfNode(const Scene& scene, int node, const DMat4& motion = DMat4(1));

}  // namespace ninefold
