#include "master/options/stop_rule.h"

#include <algorithm>

namespace ninefold {

double StopRule::fraction(int64_t doneFrames, Duration elapsed, double error) const {
  double most = 0;
  if (frames) most = std::max(most, static_cast<double>(doneFrames) / static_cast<double>(*frames));
  if (seconds) most = std::max(most, ninefold::seconds(elapsed) / *seconds);
  if (untilError && error > 0) most = std::max(most, *untilError * *untilError / (error * error));
  return std::min(most, 1.0);
}

}  // namespace ninefold
