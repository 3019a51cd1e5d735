#include "common/image/neighbour_share.h"

#include <algorithm>

namespace ninefold {
namespace {

constexpr int kReach = 2;  // of the window around a pixel

// Sums over the window, as far as it lies in the picture.
class WindowSums {
 public:
  WindowSums(int width, int height) : width_(width), height_(height) {}

  void sum(std::vector<float>& values) {
    rows_ = values;
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) {
        float s = 0;
        for (int i = std::max(0, x - kReach); i <= std::min(width_ - 1, x + kReach); ++i)
          s += values[at(i, y)];
        rows_[at(x, y)] = s;
      }
    for (int y = 0; y < height_; ++y) {
      float* out = &values[at(0, y)];
      std::fill_n(out, width_, 0.0f);
      for (int j = std::max(0, y - kReach); j <= std::min(height_ - 1, y + kReach); ++j)
        for (int x = 0; x < width_; ++x) out[x] += rows_[at(x, j)];
    }
  }

 private:
  size_t at(int x, int y) const { return pixelCount(width_, y) + static_cast<size_t>(x); }
  int width_, height_;
  std::vector<float> rows_;
};

double meanLuminance(const RgbImage& image) {
  double sum = 0;
  for (size_t i = 0; i < image.count(); ++i) sum += static_cast<double>(luminance(image.rgb(i)));
  return sum / static_cast<double>(std::max<size_t>(1, image.count()));
}

}  // namespace

NeighbourShare NeighbourShare::of(const RgbImage& filtered, const Replications<float>& u,
                                  const Replications<float>& d, int64_t frames) {
  const size_t n = filtered.count();
  NeighbourShare out{std::vector<float>(n, 1.0f), std::vector<float>(n)};
  if (frames < 2) return out;
  const auto mean = static_cast<float>(meanLuminance(filtered));
  const float least = mean * mean / 100;
  if (least == 0) return out;
  std::vector<float> covariance(n), variance(n), square(n), scale(n);
  for (size_t i = 0; i < n; ++i) {
    const Joint joint = estimateBoth(u, d, i, frames);
    const float level = luminance(filtered.rgb(i));
    scale[i] = 1 / (level * level + least);
    covariance[i] = scale[i] * static_cast<float>(joint.covariance);
    variance[i] = scale[i] * static_cast<float>(joint.second.squaredError);
    square[i] = scale[i] * static_cast<float>(joint.second.mean * joint.second.mean);
  }
  WindowSums window(filtered.width, filtered.height);
  window.sum(covariance), window.sum(variance), window.sum(square);
  std::vector<float> pixels(n, 1.0f);  // of the window
  window.sum(pixels);
  for (size_t i = 0; i < n; ++i) {
    if (square[i] == 0) continue;
    const float a = out.share[i] = std::clamp(-covariance[i] / square[i], 0.0f, 1.0f);
    const float bias = std::max(0.0f, square[i] - variance[i]) / (pixels[i] * scale[i]);
    out.squaredBias[i] = a * a * bias;
  }
  return out;
}

}  // namespace ninefold
