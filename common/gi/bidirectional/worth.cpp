#include "common/gi/bidirectional/worth.h"

#include <numeric>

namespace ninefold {
namespace {

constexpr double kDarkest = 0.1;  // of mean C: what is added to each C_i

}  // namespace

void Worth::add(const VplSet& lights, const Vpl& vpl, VplGatherScratch& scratch, RayCounts& rays) {
  Receivers& x = camera_.points;
  seen_.push_back(0);
  if (x.size() == 0) return;
  if (isBlack(vpl.power) && vpl.glossy < 0) {
    added_.insert(added_.end(), x.size(), 0.0f);
    return;
  }
  x.clearIrradiance();
  gatherOneVpl(t_, lights, vpl, 1, scratch, x, rays.shadow);
  float all = 0, visible = 0;
  for (size_t i = 0; i < x.size(); ++i) {
    const float weight = *scratch.weights.at(0, i);
    all += weight, visible += isBlack(x.irradiance(i)) ? 0 : weight;
    added_.push_back(maxComponent(camera_.shares[i] * x.irradiance(i)));
  }
  if (all > 0) seen_.back() = visible / all;
}

std::vector<float> Worth::values() const {
  const size_t points = camera_.points.size();
  std::vector<double> all(points);
  for (size_t j = 0; j < seen_.size(); ++j)
    for (size_t i = 0; i < points; ++i) all[i] += double{added_[j * points + i]};
  const double sum = std::accumulate(all.begin(), all.end(), 0.0);
  std::vector<float> values(seen_.size(), 0.0f);
  if (!(sum > 0)) return values;
  const double least = kDarkest * sum / static_cast<double>(points);
  for (size_t j = 0; j < seen_.size(); ++j)
    for (size_t i = 0; i < points; ++i)
      values[j] += static_cast<float>(double{added_[j * points + i]} / (all[i] + least));
  return values;
}

}  // namespace ninefold
