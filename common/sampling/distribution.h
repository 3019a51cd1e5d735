// distribution.h: choice among n things in proportion to given weights.
// A choice spends log2(1/probability) of the 24 bits of u: `remapped` is only as fine as what is
// left, so with very many entries take another dimension instead.
// Proved:  tests/sampling/distribution_test.cpp.
// Threads: const after construction. Errors: NINEFOLD_CHECK on negative or non-finite weights.
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
  // Weights >= 0. If all are zero the distribution is empty. Shares of the total below the smallest
  // normal float (1e-38) count as zero.
  explicit Distribution(const std::vector<float>& weights);

  bool empty() const { return cumulative_.empty(); }
  double total() const { return total_; }  // sum of the weights
  // Both not when empty. u in [0, 1); never an index of weight 0.
  Choice choose(float u) const;
  float probability(uint32_t index) const;

 private:
  std::vector<double> cumulative_;  // normalized, last element 1
  double total_ = 0;
};

}  // namespace ninefold
