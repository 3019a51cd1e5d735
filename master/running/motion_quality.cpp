#include "master/running/motion_quality.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ninefold {
namespace {

constexpr std::array kLadder{Quality{0, 0}, Quality{1, 0}, Quality{2, 0}, Quality{3, 0},
                             Quality{4, 0}, Quality{5, 0}, Quality{6, 0}, Quality{6, 1},
                             Quality{7, 1}, Quality{7, 2}, Quality{8, 2}, Quality{9, 2}};
constexpr double kLearn = 0.4;   // weight of the latest frame
constexpr double kMargin = 0.8;  // a better step must be predicted to need no more of the target
// Shares of the target. A frame that took longer calls for a smaller one; so does a long frame if
// frames are long in the mean.
constexpr double kTooLate = 1.1, kTooLong = 0.9;
constexpr int kPatience = 3;  // frames that must agree before the size grows

}  // namespace

double MotionQuality::cost(Quality q) {
  const double size = kSizes[static_cast<size_t>(q.size)];
  const double light = kLights[static_cast<size_t>(q.light)];
  return kSetShare * light + size * size * (kEyeShare + (1 - kEyeShare - kSetShare) * light);
}

std::string MotionQuality::describe(Quality q) {
  constexpr std::array kSizeNames{"",         "3/4 size",  "5/8 size", "1/2 size",  "7/16 size",
                                  "3/8 size", "5/16 size", "1/4 size", "3/16 size", "1/8 size"};
  constexpr std::array kLightNames{"", "1/2 light", "1/4 light"};
  const std::string size = kSizeNames[static_cast<size_t>(q.size)];
  const std::string light = kLightNames[static_cast<size_t>(q.light)];
  return size + (size.empty() || light.empty() ? "" : ", ") + light;
}

bool MotionQuality::fits(Quality q, Duration waited) const {
  return !full_ || *full_ * cost(q) + seconds(waited) <= kMargin * seconds(target_);
}

void MotionQuality::begin() {
  const auto found = std::ranges::find_if(kLadder, [this](Quality q) { return fits(q); });
  current_ = found == kLadder.end() ? kLadder.back() : *found;
  couldBeBetter_ = 0;
}

void MotionQuality::took(Quality quality, Duration time, Duration waited) {
  const double full = seconds(time) / cost(quality);
  full_ = full_ ? (1 - kLearn) * *full_ + kLearn * full : full;
  if (!(quality == current_)) return;  // of another gesture, or at rest
  const Quality better{std::max(0, current_.size - 1), current_.light};
  const double all = seconds(time + waited), mean = *full_ * cost(current_) + seconds(waited);
  if (all > kTooLate * seconds(target_) || std::min(all, mean) > kTooLong * seconds(target_)) {
    couldBeBetter_ = 0;
    current_.size = std::min(current_.size + 1, static_cast<int>(kSizes.size()) - 1);
  } else if (current_.size > 0 && fits(better, waited)) {
    if (++couldBeBetter_ < kPatience) return;
    couldBeBetter_ = 0;
    current_ = better;
  } else {
    couldBeBetter_ = 0;
  }
}

int scaled(int count, double factor) {
  if (count == 0) return 0;
  return std::max(1, static_cast<int>(std::lround(count * factor)));
}

}  // namespace ninefold
