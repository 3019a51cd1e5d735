#include "master/running/frame_plan.h"

#include <cmath>

namespace ninefold {

FrameKey FramePlan::next() {
  FrameKey key;
  key.frame = key.randomization = key.rotation = next_++;
  key.photonRadius = static_cast<Metres>(radius_);
  if (!converging_) return key;
  const double wider = std::sqrt(std::sqrt(2.0));
  key.photonRadius = static_cast<Metres>(key.frame % 2 == 0 ? radius_ * wider : radius_ / wider);
  constexpr double kAlpha = 2.0 / 3;
  const double i = next_;
  radius_ *= std::sqrt((i + kAlpha) / (i + 1));
  return key;
}

}  // namespace ninefold
