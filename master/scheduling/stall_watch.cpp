#include "master/scheduling/stall_watch.h"

namespace ninefold {

bool StallWatch::look(bool nothingMoves, Time now) {
  const Duration passed = last_ ? now - *last_ : Duration(0);
  last_ = now;
  if (!nothingMoves) {
    stalled_ = false, time_ = Duration(0);
    return false;
  }
  if (!std::exchange(stalled_, true)) {
    ++stalls_;
    sayAt_ = kSayAgain;
    return true;
  }
  if (passed < kPause) time_ += passed;
  if (time_ < sayAt_) return false;
  sayAt_ *= 2;
  return true;
}

}  // namespace ninefold
