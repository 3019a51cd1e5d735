// task_rays.h: how many rays a task is expected to take by its settings, its light set included:
// what the deadlines of tasks are in proportion to (scheduler_client.h).
//
//     n = p (2 + v) + v + 4 f        instant radiosity: p pixels, v VPLs, f photons of a set; a photon
//                                    meets four surfaces
//     n = 64 p                       path tracing: 32 vertices, each with a ray to a light
//
// of one phase of a tile. A whole tile has all phases, each with a border as large as itself, and
// all light sets. The order of magnitude is what counts.
// Threads: pure function.
#pragma once

#include "master/scheduling/frame_order.h"

namespace ninefold {

inline double raysOfTask(const FrameOrder& order) {
  const Settings& s = order.settings;
  const bool whole = order.delivery.wholeTiles();
  const double pixels = kTaskSide * kTaskSide * (whole ? 2 : 1);
  const double vpls = s.directVpls + s.indirectVpls;
  const double phase =
      s.method == Method::pathTrace ? 64 * pixels : pixels * (2 + vpls) + vpls + 4.0 * s.photons;
  return whole ? phase * s.interleave.sets() : phase;
}

}  // namespace ninefold
