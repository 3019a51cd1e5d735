#include "common/gi/bidirectional/worth.h"

#include <numeric>

namespace ninefold {
namespace {

constexpr double kDarkest = 0.1;  // of mean C: what is added to each C_i

}  // namespace

Worth::Worth(const Transport& transport, const CameraPoints& camera) : t_(transport) {
  for (size_t j = 0; j < camera.judges(); ++j) {
    judges_.add(camera.points.at(camera.judge(j)));
    shares_.push_back(camera.shares[camera.judge(j)]);
  }
  judges_.pad();
}

void Worth::add(const VplSet& lights, const Vpl& vpl, VplGatherScratch& scratch, RayCounts& rays) {
  seen_.push_back(0);
  reached_ = 0;
  if (judges_.size() == 0) return;
  if (isBlack(vpl.power) && vpl.glossy < 0) {
    added_.insert(added_.end(), judges_.size(), 0.0f);
    return;
  }
  judges_.clearIrradiance();
  gatherOneVpl(t_, lights, vpl, 1, scratch, judges_, rays.shadow);
  float all = 0, visible = 0;
  for (size_t i = 0; i < judges_.size(); ++i) {
    const float weight = *scratch.weights.at(0, i);
    const bool isReached = !isBlack(judges_.irradiance(i));
    if (isReached) reached_ |= 1u << i;
    all += weight, visible += isReached ? weight : 0;
    added_.push_back(maxComponent(shares_[i] * judges_.irradiance(i)));
  }
  if (all > 0) seen_.back() = visible / all;
}

void Worth::scale(float factor) {
  for (size_t i = added_.size() - judges_.size(); i < added_.size(); ++i) added_[i] *= factor;
}

std::vector<float> Worth::values() const {
  const size_t judges = judges_.size();
  std::vector<double> all(judges);
  for (size_t j = 0; j < seen_.size(); ++j)
    for (size_t i = 0; i < judges; ++i) all[i] += double{added_[j * judges + i]};
  const double sum = std::accumulate(all.begin(), all.end(), 0.0);
  std::vector<float> values(seen_.size(), 0.0f);
  if (!(sum > 0)) return values;
  const double least = kDarkest * sum / static_cast<double>(judges);
  for (size_t j = 0; j < seen_.size(); ++j)
    for (size_t i = 0; i < judges; ++i)
      values[j] += static_cast<float>(double{added_[j * judges + i]} / (all[i] + least));
  return values;
}

}  // namespace ninefold
