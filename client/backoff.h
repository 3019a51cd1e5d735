// backoff.h: how long to wait before dialling a master again. Pure.
//
//   delay = min(kLongest, kFirst 2^n) (1/2 + u/2)     n  failures in a row
//                                                     u  in [0, 1), from the seed
//
// The random half keeps a room full of clients from dialling a restarted master in step.
#pragma once

#include <algorithm>
#include <cstdint>

#include "common/base/clock.h"

namespace ninefold {

class Backoff {
 public:
  static constexpr Duration kFirst = milliseconds(250);
  static constexpr Duration kLongest = std::chrono::seconds(8);

  explicit Backoff(uint64_t seed) : state_(seed) {}

  Duration next() {
    const Duration whole = std::min(kLongest, kFirst * (1 << std::min(failures_++, 10)));
    // A step of a 64-bit linear congruential generator (Knuth's constants); its high bits are good.
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    const double u = static_cast<double>(state_ >> 32) * 0x1p-32;
    return fromSeconds(seconds(whole) * (0.5 + 0.5 * u));
  }
  void reset() { failures_ = 0; }

 private:
  uint64_t state_;
  int failures_ = 0;
};

}  // namespace ninefold
