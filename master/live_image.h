// live_image.h: what a live session shows of one frame. Plain data; constant once it is published.
#pragma once

#include <cstdint>
#include <vector>

#include "common/image/image.h"
#include "common/image/tone_map.h"

namespace ninefold {

struct LiveImage {
  RgbImage radiance;
  float exposure = 0;             // [EV] of `display`
  DisplayImage display;           // of `radiance`; empty if nobody looks
  std::vector<uint32_t> objects;  // as kObjectPlane, if the frame carried it and depth; else empty
  std::vector<float> depth;       // as kDepthPlane, likewise

  int width() const { return radiance.width; }
  int height() const { return radiance.height; }
  size_t at(int x, int y) const { return radiance.at(x, y); }
  size_t count() const { return radiance.count(); }
};

}  // namespace ninefold
