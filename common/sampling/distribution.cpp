#include "common/sampling/distribution.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "common/base/error.h"

namespace ninefold {

Distribution::Distribution(const std::vector<float>& weights) {
  for (const float w : weights) {
    NINEFOLD_CHECK(std::isfinite(w));
    NINEFOLD_CHECK(w >= 0);
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

Distribution::Choice Distribution::choose(float sample) const {
  const double u = static_cast<double>(sample) + 0x1p-25;  // the middle of what it stands for
  // The first end above u is that of a non-empty interval: an empty one ends with its predecessor.
  const auto end = std::upper_bound(cumulative_.begin(), cumulative_.end(), u);
  const auto index = static_cast<uint32_t>(end - cumulative_.begin());
  const double begin = index == 0 ? 0 : cumulative_[index - 1];
  const auto place = static_cast<float>((u - begin) / (*end - begin));
  return {index, static_cast<float>(*end - begin), std::min(place, 1.0f - 0x1p-24f)};
}

float Distribution::probability(uint32_t index) const {
  return static_cast<float>(cumulative_[index] - (index == 0 ? 0 : cumulative_[index - 1]));
}

std::vector<double> partlyAlike(const std::vector<double>& weights) {
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  const auto some = std::count_if(weights.begin(), weights.end(), [](double w) { return w > 0; });
  std::vector<double> shares;
  shares.reserve(weights.size());
  for (const double w : weights)
    shares.push_back(w > 0 ? (1 - kAlike) * w / total + kAlike / static_cast<double>(some) : 0);
  return shares;
}

}  // namespace ninefold
