// task_rays.h: how many rays a task is expected to take by its settings, its light set included.
// Deadlines of tasks are in proportion to it (scheduler_client.h); the order of magnitude counts.
//
// The method's facts say how many rays p pixels of one phase of a tile take (methods.cpp). A whole
// tile has all phases, each with a border as large as itself, and all light sets.
// Threads: pure function.
#pragma once

#include "common/scene/methods.h"
#include "master/scheduling/frame_order.h"

namespace ninefold {

inline double raysOfTask(const FrameOrder& order) {
  const Settings& s = order.settings;
  const bool whole = order.delivery.wholeTiles();
  const double pixels = kTaskSide * kTaskSide * (whole ? 2 : 1);
  const double phase = factsOf(s.method).rays(s, pixels);
  return whole ? phase * s.interleave.sets() : phase;
}

}  // namespace ninefold
