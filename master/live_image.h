// live_image.h: what a live session shows of one frame. Plain data; constant once it is published.
#pragma once

#include <cstdint>
#include <vector>

#include "common/image/image.h"
#include "common/image/tone_map.h"

namespace ninefold {

struct LiveImage {
  int width = 0, height = 0;
  RgbImage radiance;              // empty if clients sent codes
  float exposure = 0;             // [EV] of `display`
  DisplayImage display;           // of the radiance; empty if nobody looks
  std::vector<uint32_t> objects;  // as kObjectPlane, if the frame carried it and depth; else empty
  std::vector<float> depth;       // as kDepthPlane, likewise

  size_t at(int x, int y) const { return pixelCount(width, y) + static_cast<size_t>(x); }
};

}  // namespace ninefold
