// texture_peaks.h: the largest value that a texture can have over a range of texture coordinates;
// never too small, so that no light that shines anywhere is taken for dark. It keeps maxima over at
// most 64 x 64 cells.
// Owner: value type.   Threads: const after construction.
#pragma once

#include <vector>

#include "common/scene/scene.h"

namespace ninefold {

class TexturePeaks {
 public:
  explicit TexturePeaks(const TextureImage& image);

  // Largest R, G or B, linear, of lookups with coordinates (after the use's transform) in the box.
  float largest(const TextureUse& use, Vec2 low, Vec2 high) const;

 private:
  static constexpr int kCells = 64;
  struct Axis {
    int texels = 1, cells = 1;
    int cellOf(int texel) const { return static_cast<int>(int64_t{texel} * cells / texels); }
    std::vector<int> cellsBetween(float low, float high, Wrap wrap) const;
  };

  size_t cell(int column, int row) const {
    return static_cast<size_t>(row) * static_cast<size_t>(x_.cells) + static_cast<size_t>(column);
  }

  Axis x_, y_;
  std::vector<float> peaks_;
};

}  // namespace ninefold
