#include "common/image/ssim.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "common/image/tone_map.h"

namespace ninefold {
namespace {

using Plane = std::vector<double>;

constexpr int kRadius = 5;
constexpr double kSigma = 1.5, kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;

Plane codesOf(const RgbImage& image, double exposure) {
  Plane out(image.count());
  for (size_t i = 0; i < out.size(); ++i) {
    const double y = exposure * static_cast<double>(luminance(image.rgb(i)));
    out[i] = static_cast<double>(srgbFromLinear(std::clamp(static_cast<float>(y), 0.0f, 1.0f)));
  }
  return out;
}

// Gaussian window along one axis: `step` apart, `length` values in a line, `lines` starts each
// `lineStep` apart.
struct Axis {
  int length, step, lines, lineStep;
};

Plane blur(const Plane& in, Axis axis) {
  double kernel[kRadius + 1];
  for (int k = 0; k <= kRadius; ++k) kernel[k] = std::exp(-0.5 * k * k / (kSigma * kSigma));
  Plane out(in.size());
  for (int line = 0; line < axis.lines; ++line)
    for (int i = 0; i < axis.length; ++i) {
      double sum = 0, weight = 0;
      for (int k = std::max(i - kRadius, 0); k <= std::min(i + kRadius, axis.length - 1); ++k) {
        const double w = kernel[std::abs(k - i)];
        sum += w * in[static_cast<size_t>(line * axis.lineStep + k * axis.step)];
        weight += w;
      }
      out[static_cast<size_t>(line * axis.lineStep + i * axis.step)] = sum / weight;
    }
  return out;
}

// Mean of a b under the window around each pixel.
Plane windowMean(const Plane& a, const Plane* b, int width, int height) {
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
  const int w = image.width, h = image.height;
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
