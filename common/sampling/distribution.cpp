#include "common/sampling/distribution.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/error.h"

namespace ninefold {

Distribution::Distribution(const std::vector<float>& weights) {
  for (const float w : weights) {
    NINEFOLD_CHECK(std::isfinite(w) && w >= 0);
    total_ += w;
  }
  if (total_ == 0) return;
  // A share too small for a float would later be divided by as 0: it counts as weight 0.
  const double least = total_ * std::numeric_limits<float>::min();
  double kept = 0;
  cumulative_.reserve(weights.size());
  for (const float w : weights) {
    if (w >= least) kept += w;
    cumulative_.push_back(kept);
  }
  for (double& c : cumulative_) c /= kept;
}

Distribution::Choice Distribution::choose(float u) const {
  // The first end above u is that of a non-empty interval: an empty one ends with its predecessor.
  const auto end = std::upper_bound(cumulative_.begin(), cumulative_.end(), static_cast<double>(u));
  const auto index = static_cast<uint32_t>(end - cumulative_.begin());
  const double begin = index == 0 ? 0 : cumulative_[index - 1];
  const auto place = static_cast<float>((u - begin) / (*end - begin));
  return {index, static_cast<float>(*end - begin), std::min(place, 1.0f - 0x1p-24f)};
}

float Distribution::probability(uint32_t index) const {
  return static_cast<float>(cumulative_[index] - (index == 0 ? 0 : cumulative_[index - 1]));
}

}  // namespace ninefold
