#include "common/image/neighbour_share.h"

#include <algorithm>
#include <cmath>

namespace ninefold {
namespace {

// Weighted sums over the window, as far as it lies in the picture.
class WindowSums {
 public:
  WindowSums(int width, int height, Interleave pattern)
      : width_(width), height_(height), pattern_(pattern), rows_(pixelCount(width, height)) {}

  void sum(std::vector<float>& values) {
    std::ranges::fill(rows_, 0.0f);
    for (int i = 1 - pattern_.n; i < pattern_.n; ++i)
      for (int y = 0; y < height_; ++y)
        add(&values[at(0, y)], i, static_cast<float>(pattern_.n - std::abs(i)), &rows_[at(0, y)]);
    std::ranges::fill(values, 0.0f);
    for (int j = 1 - pattern_.m; j < pattern_.m; ++j)
      for (int y = std::max(0, -j); y < std::min(height_, height_ - j); ++y)
        add(&rows_[at(0, y + j)], 0, static_cast<float>(pattern_.m - std::abs(j)),
            &values[at(0, y)]);
  }

 private:
  // out[x] += weight * row[x + shift]
  void add(const float* row, int shift, float weight, float* out) const {
    const int end = std::min(width_, width_ - shift);
#pragma GCC ivdep
    for (int x = std::max(0, -shift); x < end; ++x) out[x] += weight * row[x + shift];
  }
  size_t at(int x, int y) const { return pixelCount(width_, y) + static_cast<size_t>(x); }

  int width_, height_;
  Interleave pattern_;
  std::vector<float> rows_;
};

double meanLuminance(const RgbImage& image) {
  double sum = 0;
  for (size_t i = 0; i < image.count(); ++i)
    if (const float y = luminance(image.rgb(i)); std::isfinite(y)) sum += static_cast<double>(y);
  return sum / static_cast<double>(std::max<size_t>(1, image.count()));
}

}  // namespace

NeighbourShare NeighbourShare::of(const RgbImage& filtered, const Replications<float>& shift,
                                  int64_t frames, Interleave pattern) {
  constexpr float kChance = 2;  // c
  const size_t n = filtered.count();
  NeighbourShare out{std::vector<float>(n, 1.0f), std::vector<float>(n)};
  const auto mean = static_cast<float>(meanLuminance(filtered));
  const float least = mean * mean / 100;
  if (frames < kFirst || least == 0) return out;
  std::vector<float> variance(n), square(n), scale(n), weight(n, 1.0f);
  for (size_t i = 0; i < n; ++i) {
    const Estimate d = shift.estimate(i, frames);
    const float level = luminance(filtered.rgb(i));
    if (!std::isfinite(level) || !std::isfinite(d.squaredError)) continue;  // scale 0
    scale[i] = 1 / (level * level + least);
    variance[i] = scale[i] * static_cast<float>(d.squaredError);
    square[i] = scale[i] * static_cast<float>(d.mean * d.mean);
  }
  WindowSums window(filtered.width, filtered.height, pattern);
  for (auto* values : {&variance, &square, &weight}) window.sum(*values);
  for (size_t i = 0; i < n; ++i) {
    const float bias = std::max(0.0f, square[i] - kChance * variance[i]);
    if (bias == 0 || scale[i] == 0) continue;
    const float a = out.share[i] = variance[i] / (variance[i] + bias);
    out.squaredBias[i] = a * a * bias / (weight[i] * scale[i]);
  }
  return out;
}

}  // namespace ninefold
