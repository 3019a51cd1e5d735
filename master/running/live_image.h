// live_image.h: what a live session shows of one frame. Plain data; constant once it is published.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "common/image/image.h"
#include "common/image/tone_map.h"

namespace ninefold {

// What is at each place of a picture.
struct PickPlanes {
  std::vector<uint32_t> objects;  // as kObjectPlane
  std::vector<float> depth;       // as kDepthPlane
};

struct LiveImage {
  int width = 0, height = 0;
  RgbImage radiance;     // empty if clients sent codes
  Tone tone;             // of `display`
  DisplayImage display;  // of the radiance; empty if nobody looks
  // Of the frame, or of an earlier one at rest, which shows the same; null if neither carried them.
  std::shared_ptr<const PickPlanes> picks;

  size_t at(int x, int y) const { return pixelCount(width, y) + static_cast<size_t>(x); }
};

}  // namespace ninefold
