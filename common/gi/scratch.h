// scratch.h: the working memory of one thread; nothing is allocated per pixel or ray once it has
// grown. Threads: one owner at a time.
#pragma once

#include <array>
#include <deque>
#include <vector>

#include "common/gi/receivers.h"
#include "common/image/layers.h"

namespace ninefold {

struct Scratch {
  std::array<Receivers, kLayers> receivers;
  std::array<std::vector<uint32_t>, kLayers>
      places;                     // index in the task's rectangle of each receiver
  std::deque<Receivers> bounced;  // compensation: one level a bounce, as deep as it ever went
};

}  // namespace ninefold
