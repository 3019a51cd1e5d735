// scratch.h: the working memory of one thread; nothing is allocated per pixel or ray once it has
// grown. Threads: one owner at a time.
#pragma once

#include <array>
#include <deque>
#include <vector>

#include "common/gi/receivers.h"
#include "common/gi/vpl_gather.h"
#include "common/image/layers.h"

namespace ninefold {

// What the compensation's rays met, and where its irradiance goes: `factor` times it to `receiver`.
struct Bounces {
  struct Parent {
    size_t receiver;
    Vec3 factor;
  };
  Receivers points;
  std::vector<Parent> parents;

  void clear() { points.clear(), parents.clear(); }
};

struct Scratch {
  std::array<Receivers, kLayers> receivers;
  std::array<std::vector<uint32_t>, kLayers>
      places;  // index in the task's rectangle of each receiver
  VplGatherScratch vplGather;
  std::deque<Bounces> bounced;  // compensation: one level a bounce, as deep as it ever went
};

}  // namespace ninefold
