#include "master/frame_plan.h"

#include <cmath>

namespace ninefold {

FrameKey FramePlan::next() {
  FrameKey key;
  key.frame = key.randomization = key.rotation = next_++;
  key.photonRadius = static_cast<Metres>(radius_);
  constexpr double kAlpha = 0.5;
  const double i = next_;
  if (converging_) radius_ *= std::sqrt((i + kAlpha) / (i + 1));
  return key;
}

}  // namespace ninefold
