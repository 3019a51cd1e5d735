// image_limits.h: the largest image file that is taken in, by the size that it claims.
#pragma once

#include <cstdint>

namespace ninefold {

struct ImageLimits {
  uint64_t side = 0;      // largest width and height
  uint64_t texels = 0;    // largest width * height
  bool isShared = false;  // they are what other images have left
};

}  // namespace ninefold
