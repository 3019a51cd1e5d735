#include "common/gi/bidirectional/effort.h"

#include <cmath>

#include "common/gi/bidirectional/light_maker.h"
#include "common/gi/vpl/indirect_vpls.h"

namespace ninefold {
namespace {

constexpr double kMostReverse = 0.4, kMostUneven = 12;
constexpr uint32_t kPilotRandomization = 0xffffff00u;  // of no frame
constexpr int kPilotSets = 9;

std::vector<WorthSummary> pilotOf(const Transport& t, const ViewChoice& choice, const View& view) {
  FrameKey key;
  key.randomization = kPilotRandomization, key.photonRadius = t.settings.photonRadius * t.radius;
  const Batch whole{0, batchesLog2(t.settings)};
  std::vector<WorthSummary> sets;
  for (int set = 0; set < kPilotSets; ++set)
    sets.push_back(LightMaker(t, choice, whole, key, set, {&view, 1}).summary());
  return sets;
}

}  // namespace

WorthSummary summaryOf(std::span<const float> values, size_t firstReverse) {
  double sum = 0, squares = 0, reverse = 0;
  for (size_t j = 0; j < values.size(); ++j) {
    if (!std::isfinite(values[j])) continue;
    const double v{values[j]};
    sum += v, squares += v * v;
    if (j >= firstReverse) reverse += v;
  }
  if (!(sum > 0)) return {};
  return {reverse / sum, static_cast<double>(values.size()) * squares / (sum * sum)};
}

bool fewWillDo(std::span<const WorthSummary> sets) {
  double reverse = 0, uneven = 0;
  for (const WorthSummary& set : sets) reverse += set.reverse, uneven += set.uneven;
  const auto n = static_cast<double>(sets.size());
  return reverse < kMostReverse * n && uneven < kMostUneven * n;
}

ViewChoice viewChoiceFor(const Transport& t, const ViewChoice& byMethod, const View& view) {
  ViewChoice choice = byMethod;
  const LampChoice lamps = lampChoiceFor(t, view, byMethod.pathsLog2 >= 0);
  if (lamps.transport != nullptr)
    choice.transport = lamps.transport, choice.standard = lamps.standard;
  const Settings& s = t.settings;
  if (s.partition == PartitionRule::equal || s.resampling < 5) return choice;
  if (!fewWillDo(pilotOf(t, choice, view))) return choice;
  auto few = std::make_shared<Transport>(choice.transport != nullptr ? *choice.transport : t);
  few->settings.resampling = s.resampling / 5;
  few->settings.cameraPoints = std::max(s.cameraPoints / 2, 1);
  choice.pathsLog2 = lightPathsLog2(t, few->settings.resampling * s.indirectVpls);
  choice.transport = std::move(few);
  return choice;
}

ViewChoice ViewChoices::of(const Transport& t, const ViewChoice& byMethod, const View& view) const {
  const std::lock_guard lock(mutex_);
  const bool isThere = view_ && view_->camera == view.camera && view_->width == view.width &&
                       view_->height == view.height;
  if (!isThere) choice_ = viewChoiceFor(t, byMethod, view), view_ = view;
  return choice_;
}

}  // namespace ninefold
