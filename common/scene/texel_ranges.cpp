#include "common/scene/texel_ranges.h"

#include <algorithm>

namespace ninefold {
namespace {

TexelRanges lookAtAll(const TextureImage& image) {
  TexelRanges ranges;
  const auto channels = static_cast<size_t>(image.channels);
  for (size_t i = 0; i + channels <= image.texels.size(); i += channels)
    for (size_t c = 0; c < channels; ++c) {
      ranges[c].low = std::min(ranges[c].low, image.texels[i + c]);
      ranges[c].high = std::max(ranges[c].high, image.texels[i + c]);
    }
  return ranges;
}

}  // namespace

TexelRanges texelRanges(const TextureImage& image) {
  return image.ranges ? *image.ranges : lookAtAll(image);
}

void keepTexelRanges(Scene& scene) {
  for (TextureImage& image : scene.images) image.ranges = lookAtAll(image);
}

}  // namespace ninefold
