// scratch.h: the working memory of one thread; nothing is allocated per pixel or ray once it has
// grown. Threads: one owner at a time.
#pragma once

#include <array>
#include <vector>

#include "common/gi/receivers.h"
#include "common/image/layers.h"

namespace ninefold {

inline constexpr int kMaxBounces = 16;  // of the compensation's recursion

struct Scratch {
  std::array<Receivers, kLayers> receivers;
  std::array<std::vector<uint32_t>, kLayers>
      places;                                  // index in the task's rectangle of each receiver
  std::array<Receivers, kMaxBounces> bounced;  // compensation: one level a bounce
};

}  // namespace ninefold
