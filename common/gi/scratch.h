// scratch.h: the working memory of one thread; nothing is allocated per pixel or ray once it has
// grown. Threads: one owner at a time.
#pragma once

#include <array>

#include "common/gi/receivers.h"
#include "common/image/layers.h"

namespace ninefold {

struct Scratch {
  std::array<Receivers, kLayers> receivers;
};

}  // namespace ninefold
