#include "common/image/auto_exposure.h"

#include <algorithm>
#include <cmath>

#include "common/image/tone_map.h"

namespace ninefold {

float autoExposure(const RgbImage& radiance) {
  double sum = 0;
  size_t count = 0;
  for (size_t i = 0; i < radiance.count(); ++i) {
    const float y = luminance(radiance.rgb(i));
    if (!(y > 0) || !std::isfinite(y)) continue;
    sum += std::log2(static_cast<double>(y)), ++count;
  }
  if (count == 0) return 0;
  const double ev = std::log2(kMiddleGrey) - sum / static_cast<double>(count);
  constexpr double kMost{kMostExposure};
  return static_cast<float>(std::clamp(std::round(10 * ev) / 10, -kMost, kMost));
}

}  // namespace ninefold
