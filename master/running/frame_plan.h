// frame_plan.h: the keys of a run's frames while the picture rests. Pure.
//
// Frame i (counted from 1) has randomization and rotation i - 1: every pixel meets every light set,
// and frames have light of their own. F R is the photon radius that was set, R the scene's radius,
// K the number of light sets:
//
//     r(1) = F R     r^2(i+1) = r^2(i) (i + a) / (i + 1),  a = 2/3       photon radius [m]
//     frames i take 2^(1/4) r(i) and 2^(-1/4) r(i) by turns, so that the film sees its bias
//                                                                        (image/radius_bias.h)
//     w(i) = min(1, K / i)                      weight of neighbours in tiles that clients filter
//
// Both biases die out, so that the film's mean tends to the true picture. Where the master filters,
// the film finds the neighbours' share by itself (image/neighbour_share.h). Clients send filtered
// tiles alone: the first K frames filter fully, for until then a pixel has not met all K sets by
// itself. The paper's own pipeline keeps r and w = 1 fixed.
//
// With a = 2/3 noise and blur of a smooth E fall alike, as i^(-2/3) of the squared error; rims,
// which blur more slowly, are the narrower photons' part (gi/photons/photon_spread.h).
//
// Source: Knaus and Zwicker, "Progressive Photon Mapping: A Probabilistic Approach", 2011 (r, a).
// Proved: tests/master/frame_plan_test.cpp.   Threads: plain value.
#pragma once

#include <algorithm>

#include "common/scene/settings.h"

namespace ninefold {

class FramePlan {
 public:
  FramePlan(Metres firstRadius, int sets, bool converging)
      : radius_(firstRadius), sets_(static_cast<float>(sets)), converging_(converging) {}

  // The next frame's key; indices are given out in order, from 0.
  FrameKey next();
  int64_t opened() const { return next_; }
  // As if so many frames had been opened.
  void skip(int64_t frames) {
    while (frames-- > 0) next();
  }

  // w of a frame, by its index from 0.
  float neighbourWeight(uint32_t frame) const {
    return converging_ ? std::min(1.0f, sets_ / static_cast<float>(frame + 1)) : 1.0f;
  }

 private:
  uint32_t next_ = 0;
  double radius_;
  float sets_;  // K
  bool converging_;
};

}  // namespace ninefold
