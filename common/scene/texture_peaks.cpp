#include "common/scene/texture_peaks.h"

#include "common/scene/texture.h"

namespace ninefold {

TexturePeaks::TexturePeaks(const TextureImage& image)
    : x_{image.width, std::min(image.width, kCells)},
      y_{image.height, std::min(image.height, kCells)},
      peaks_(static_cast<size_t>(x_.cells) * static_cast<size_t>(y_.cells), 0.0f) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      float& peak = peaks_[cell(x_.cellOf(x), y_.cellOf(y))];
      peak = std::max(peak, maxComponent(Vec3(texelOf(image, x, y))));
    }
}

// Cells of all texels that bilinear lookups between two coordinates may touch.
std::vector<int> TexturePeaks::Axis::cellsBetween(float low, float high, Wrap wrap) const {
  std::vector<int> touched;
  const auto size = static_cast<float>(texels);
  const bool everywhere = !(high - low < 1) || !(std::abs(low) < 1e4f);
  if (everywhere) {
    for (int c = 0; c < cells; ++c) touched.push_back(c);
    return touched;
  }
  const int first = static_cast<int>(std::floor(low * size - 1));
  const int last = static_cast<int>(std::floor(high * size + 1));
  const int step = std::max(1, texels / cells);  // no cell is narrower
  for (int t = first; t < last; t += step) touched.push_back(cellOf(wrapTexel(t, texels, wrap)));
  touched.push_back(cellOf(wrapTexel(last, texels, wrap)));
  return touched;
}

float TexturePeaks::largest(const TextureUse& use, Vec2 low, Vec2 high) const {
  const std::vector<int> columns = x_.cellsBetween(low.x, high.x, use.wrapS);
  float largest = 0;
  for (const int y : y_.cellsBetween(low.y, high.y, use.wrapT))
    for (const int x : columns) largest = std::max(largest, peaks_[cell(x, y)]);
  return largest;
}

}  // namespace ninefold
