// radius_bias.h: how far the photons' blur has moved the means of a film. Frames tell it: they take
// a wider and a narrower radius by turns (master/running/frame_plan.h), so that four of the eight
// replications have each.
//
//   D_s   mean of the four replications in s less the mean of the others; eight have 35 such halves
//   B^2 = c (D_wide^2 - mean of D_s^2 over the other 34) of each block,  c = (3/2)^2 / (1 - 2/17)
//
// Blur goes with r^2, and the radii's squares are as 2 to 1: the mean is off by 3/2 of the
// difference. The other halves show what chance makes of D, and 2/17 of the true difference.
//
// Only what cannot be chance counts: B is 0 unless the image's sum of n_b D^2 (n_b: pixels of block
// b) is larger for the true halves than for all others. By chance that happens once in 35, however
// blocks depend on each other. What is not seen is of the order of the noise or less.
//
// Source:  the exact permutation test, Fisher 1935.   Proved: tests/image/radius_bias_test.cpp.
// Threads: pure.   Errors: none; 0 before all replications have a frame.
#pragma once

#include <type_traits>

#include "common/base/error.h"
#include "common/image/replications.h"

namespace ninefold {

struct RadiusBias {
  double squared = 0;           // mean over all pixels
  std::vector<double> squares;  // by block, at least 0; empty: none

  // Of the first pixels.size() quantities; `pixels`: how many pixels each stands for.
  static RadiusBias of(const Replications<double>& blocks, std::span<const double> pixels,
                       int64_t frames);

  // Both members as visit(span). Error: as many squares as blocks, or none, and it is neither.
  template <typename Self, typename Visit>
  static void visitKept(Self& self, size_t blocks, Visit& visit) {
    visit(std::span(&self.squared, 1));
    uint64_t count = self.squares.size();
    visit(std::span(&count, 1));
    if (count != 0 && count != blocks) fail("the film has {} of {} blocks", count, blocks);
    if constexpr (!std::is_const_v<Self>) self.squares.resize(static_cast<size_t>(count));
    visit(std::span(self.squares));
  }
};

}  // namespace ninefold
