#include "common/image/auto_exposure.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/image/tone_map.h"

namespace ninefold {

float autoExposure(const RgbImage& radiance) {
  std::vector<float> luminances;
  for (size_t i = 0; i < radiance.count(); ++i) {
    const float y = luminance(radiance.rgb(i));
    if (y > 0 && std::isfinite(y)) luminances.push_back(y);
  }
  if (luminances.empty()) return 0;
  const auto rank = static_cast<size_t>(kShare * static_cast<double>(luminances.size() - 1));
  const auto place = luminances.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(luminances.begin(), place, luminances.end());
  const double ev = std::log2(kBright / static_cast<double>(*place));
  return static_cast<float>(std::round(10 * ev) / 10);
}

}  // namespace ninefold
