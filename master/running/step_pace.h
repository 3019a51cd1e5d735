// step_pace.h: how many units a step in motion has, so that it is done within a given time. Pure.
//
//   n = target / t      t: time of a unit, a mean in which the latest step counts half
//
// Threads: plain value.   Errors: none.   Proved: tests/master/step_pace_test.cpp.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "common/base/clock.h"

namespace ninefold {

class StepPace {
 public:
  // `first`: as long as no step was timed. From 1 to `most`.
  uint32_t units(uint32_t first, uint32_t most, Duration target) const {
    if (!ofUnit_) return std::clamp(first, 1u, most);
    const double wanted = std::chrono::duration<double>(target).count() / *ofUnit_;
    return static_cast<uint32_t>(std::clamp(wanted, 1.0, static_cast<double>(most)));
  }
  void took(uint32_t units, Duration time) {
    const double ofThese =
        std::max(std::chrono::duration<double>(time).count(), 1e-6) / std::max(units, 1u);
    ofUnit_ = ofUnit_ ? 0.5 * (*ofUnit_ + ofThese) : ofThese;
  }

 private:
  std::optional<double> ofUnit_;  // t [s]
};

}  // namespace ninefold
