// wire_level.h: how much compression suits a client's line. Pure.
//
//   share = (b / B) / (t / T)
//
//   b   bytes of an uncompressed result, a moving average       B   what the line takes [bytes/s]
//   t   one thread's time for a result, a moving average [s]    T   threads
//
// The line needs b/B for a result, and t/T passes from one result to the next. Below kIdle the line
// has nothing to gain. Above 1 the client waits for the line, and processor time is free. What a
// result decodes to does not depend on the level.
//
// Proved: tests/proto/wire_level_test.cpp.   Threads: plain value.
#pragma once

#include <cstddef>

#include "common/base/clock.h"

namespace ninefold {

class WireLevel {
 public:
  static constexpr double kIdle = 0.2;
  static constexpr int kNone = 0, kLight = 1, kStrong = 5;  // levels of zstd

  void finished(size_t rawBytes, Duration busy) {
    constexpr double kNew = 0.1;
    const double b = static_cast<double>(rawBytes), t = seconds(busy);
    bytes_ += (any_ ? kNew : 1.0) * (b - bytes_);
    seconds_ += (any_ ? kNew : 1.0) * (t - seconds_);
    any_ = true;
  }

  // line: B [bytes/s], 0 if it is not known yet.
  int choose(double line, int threads) const {
    if (!any_ || line <= 0 || seconds_ <= 0) return kLight;
    const double share = bytes_ / line * threads / seconds_;
    return share < kIdle ? kNone : share < 1 ? kLight : kStrong;
  }

 private:
  bool any_ = false;
  double bytes_ = 0, seconds_ = 0;
};

}  // namespace ninefold
