// metrics.h: how far an image x is from a reference r. Means run over pixels and channels.
//
//   rmse            sqrt(mean (x-r)^2)
//   rmsePercent     100 rmse / mean r
//   relMse          mean (x-r)^2/(r^2 + 0.01), both first divided by the reference's mean luminance
//   relMseTrimmed   the same without the 0.1 % of pixels (rounded down) with the largest terms
//   bias            (mean x - mean r)/mean r per channel
//   ssim            structural similarity of the luminance, see ssim.h
//   worst           the pixel with the largest term of relMse
//
// Pixels that are not finite in x or in r are counted and left out of everything; in ssim they
// count as equal. A figure without a value (all of the reference is black) is NaN.
//
// Source:  Rousselle et al. 2011 (relMSE); Wang et al. 2004 (SSIM).
// Proved:  tests/image/metrics_test.cpp.   Threads: pure.   Errors: Error if the sizes differ.
#pragma once

#include "common/image/image.h"

namespace ninefold {

struct WorstPixel {
  int x = 0, y = 0;
  Vec3 image{0}, reference{0};
  double relMse = 0;
};

struct Metrics {
  double rmse = 0, rmsePercent = 0, relMse = 0, relMseTrimmed = 0, ssim = 0;
  double bias[3] = {0, 0, 0};
  WorstPixel worst;
  int64_t nonFiniteImage = 0, nonFiniteReference = 0;  // pixels
};

Metrics compareImages(const RgbImage& image, const RgbImage& reference);

}  // namespace ninefold
