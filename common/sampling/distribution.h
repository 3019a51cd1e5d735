// distribution.h: choice among n things in proportion to given weights.
//
// A sample u is a multiple of 2^-24 and stands for the middle of that interval. A choice spends
// log2(1/probability) of its 24 bits, and `remapped` is as fine as the bits that are left: coarse
// for a rare choice, but with the right mean. A share below 2^-24 is found by luck or never: see
// partlyAlike.
//
// Proved:  tests/sampling/distribution_test.cpp.
// Threads: const after construction.   Errors: NINEFOLD_CHECK on negative or non-finite weights.
#pragma once

#include <cstdint>
#include <vector>

namespace ninefold {

class Distribution {
 public:
  struct Choice {
    uint32_t index;
    float probability;
    float remapped;  // u's place inside the chosen interval, again uniform in [0, 1)
  };

  Distribution() = default;
  // Weights >= 0. If all are zero the distribution is empty. A share of the total below 1e-38 (the
  // smallest normal float) counts as zero.
  explicit Distribution(const std::vector<float>& weights);

  bool empty() const { return cumulative_.empty(); }
  double total() const { return total_; }  // sum of the weights
  // Neither when empty. u in [0, 1). choose() never gives an index of weight 0.
  Choice choose(float u) const;
  float probability(uint32_t index) const;

 private:
  std::vector<double> cumulative_;  // normalized, last element 1
  double total_ = 0;
};

// Shares p_i of n weights w_i > 0: (1 - kAlike) w_i / sum w + kAlike / n; 0 where w_i = 0. What is
// faint on the whole may be all that there is at some place.
inline constexpr double kAlike = 0.1;
std::vector<double> partlyAlike(const std::vector<double>& weights);

}  // namespace ninefold
