#include "common/image/ssim.h"

#include <algorithm>
#include <cmath>

#include "common/image/tone_map.h"

namespace ninefold {
namespace {

using Plane = std::vector<double>;

constexpr size_t kRadius = 5;
constexpr double kSigma = 1.5, kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;

Plane codesOf(const RgbImage& image, double exposure) {
  Plane out(image.count());
  for (size_t i = 0; i < out.size(); ++i) {
    const double y = exposure * static_cast<double>(luminance(image.rgb(i)));
    out[i] = static_cast<double>(srgbFromLinear(std::clamp(static_cast<float>(y), 0.0f, 1.0f)));
  }
  return out;
}

// Gaussian window along one axis: `lines` lines of `length` values each.
struct Axis {
  size_t length, step;     // from value to value
  size_t lines, lineStep;  // from line to line
};

// Weighted mean around value i of a line that starts at `line`.
double windowAt(const double* line, const Axis& axis, size_t i, const double* kernel) {
  double sum = 0, weight = 0;
  const size_t last = std::min(i + kRadius, axis.length - 1);
  for (size_t k = i - std::min(i, kRadius); k <= last; ++k) {
    const double w = kernel[k > i ? k - i : i - k];
    sum += w * line[k * axis.step];
    weight += w;
  }
  return sum / weight;
}

Plane blur(const Plane& in, const Axis& axis) {
  double kernel[kRadius + 1];
  for (size_t k = 0; k <= kRadius; ++k)
    kernel[k] = std::exp(-0.5 * static_cast<double>(k * k) / (kSigma * kSigma));
  Plane out(in.size());
  for (size_t line = 0; line < axis.lines; ++line)
    for (size_t i = 0; i < axis.length; ++i)
      out[line * axis.lineStep + i * axis.step] =
          windowAt(in.data() + line * axis.lineStep, axis, i, kernel);
  return out;
}

// Mean of a b under the window around each pixel.
Plane windowMean(const Plane& a, const Plane* b, size_t width, size_t height) {
  Plane product = a;
  if (b != nullptr)
    for (size_t i = 0; i < product.size(); ++i) product[i] *= (*b)[i];
  return blur(blur(product, {width, 1, height, width}), {height, width, width, 1});
}

}  // namespace

double structuralSimilarity(const RgbImage& image, const RgbImage& reference,
                            double referenceMeanLuminance) {
  const double exposure = 0.18 / referenceMeanLuminance;
  const Plane x = codesOf(image, exposure), r = codesOf(reference, exposure);
  const size_t w = static_cast<size_t>(image.width), h = static_cast<size_t>(image.height);
  const Plane mx = windowMean(x, nullptr, w, h), mr = windowMean(r, nullptr, w, h);
  const Plane xx = windowMean(x, &x, w, h), rr = windowMean(r, &r, w, h);
  const Plane xr = windowMean(x, &r, w, h);
  double sum = 0;
  for (size_t i = 0; i < x.size(); ++i) {
    const double varianceX = xx[i] - mx[i] * mx[i], varianceR = rr[i] - mr[i] * mr[i];
    const double covariance = xr[i] - mx[i] * mr[i];
    sum += (2 * mx[i] * mr[i] + kC1) * (2 * covariance + kC2) /
           ((mx[i] * mx[i] + mr[i] * mr[i] + kC1) * (varianceX + varianceR + kC2));
  }
  return sum / static_cast<double>(x.size());
}

}  // namespace ninefold
