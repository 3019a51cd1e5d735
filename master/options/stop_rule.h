// stop_rule.h: when a headless run has enough frames. It stops at the first limit that is met.
//
// The error is looked at only after N = 16, 32, 64, ... frames: a rule that looked after every
// frame would stop too early, just when the estimate happens to be low.
// Threads: plain value.
#pragma once

#include <cstdint>
#include <optional>

#include "common/base/clock.h"

namespace ninefold {

struct StopRule {
  std::optional<int64_t> frames = {};
  std::optional<double> seconds = {};     // since the first dispatch
  std::optional<double> untilError = {};  // relative standard error, film.h

  static constexpr int64_t kFirstLook = 16;

  static bool looksAtError(int64_t frames) {
    return frames >= kFirstLook && (frames & (frames - 1)) == 0;
  }

  // `error`: after these frames; only used when looksAtError(frames).
  bool isMet(int64_t doneFrames, Duration elapsed, double error) const {
    return (frames && doneFrames >= *frames) ||
           (seconds && doneFrames > 0 && ninefold::seconds(elapsed) >= *seconds) ||
           (untilError && looksAtError(doneFrames) && error <= *untilError);
  }

  // How far the run has come, 0 to 1, as well as can be known: error falls as 1/sqrt(frames).
  double fraction(int64_t doneFrames, Duration elapsed, double error) const;
};

}  // namespace ninefold
