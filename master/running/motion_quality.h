// motion_quality.h: how good a frame may be while something moves, so that it is done within a
// target time. Pure: durations in, steps out.
//
//   c(size, light) = s light + size^2 (e + (1 - e - s) light)    cost of a frame; of a full one 1
//
//   size    one of kSizes; width and height are multiplied by it
//   light   one of kLights; the numbers of VPLs and photons are multiplied by it
//   s = kSetShare   making the light sets, whatever the size
//   e = kEyeShare   eye paths, the filter, and the shadow rays that thinning does not save because
//                   roulette has left them out already (gi/vpl/vpl_roulette.h)
//
// The time of a full frame is learned from every frame that is timed. What a frame waited for, such
// as a step of a method's state, is not part of that time. It counts against the target.
//
// When a gesture begins, the first step is taken that is predicted to keep the target: size falls
// to 5/16 before the light is thinned, which saves little. The light then stays until the gesture
// ends, so that nothing flickers. The size still follows the clock: down at once, when a frame is
// late or frames are long in the mean; up, when three frames in a row say so.
//
// Threads: plain value.   Errors: none.   Proved: tests/master/motion_quality_test.cpp.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "common/base/clock.h"

namespace ninefold {

struct Quality {
  int size = 0;   // index into kSizes
  int light = 0;  // index into kLights
  bool operator==(const Quality&) const = default;
};

class MotionQuality {
 public:
  static constexpr std::array kSizes{1.0,   0.75,   0.625, 0.5,    0.4375,
                                     0.375, 0.3125, 0.25,  0.1875, 0.125};
  static constexpr std::array kLights{1.0, 0.5, 0.25};
  static constexpr double kSetShare = 0.1, kEyeShare = 0.7;

  explicit MotionQuality(Duration target) : target_(target) {}

  void begin();  // of a gesture
  Quality current() const { return current_; }
  // A frame that somebody waited for was done in this quality; the first at rest counts, too.
  // `waited`: before that, for other work of the clients, which a smaller frame does not shorten.
  void took(Quality quality, Duration time, Duration waited = {});

  Duration target() const { return target_; }
  void setTarget(Duration target) { target_ = target; }

  static double cost(Quality quality);
  // "1/2 size, 1/4 light": what people are told; empty for full quality.
  static std::string describe(Quality quality);

 private:
  bool fits(Quality quality, Duration waited = {}) const;

  Duration target_;
  std::optional<double> full_;  // learned time of a full frame [s]
  Quality current_;
  int couldBeBetter_ = 0;  // frames in a row
};

// count * factor for VPLs, photons, or pixels along a side: at least 1, if count is.
int scaled(int count, double factor);

}  // namespace ninefold
