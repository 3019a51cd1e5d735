// chi_square.h: Pearson's test of samples against the density that they claim to have.
//
// A domain is cut into cells; `expected` holds n times the integral of the density over each cell,
// the last entry n times the chance of no sample at all. Cells with small expectation are pooled.
// The test accepts unless the statistic is less likely than `significance`, Sidak-corrected for the
// number of tests made.
#pragma once

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <numeric>
#include <vector>

namespace ninefold {

// p-value of the observed counts; 0 when something fell where the density is zero.
inline double chiSquareP(const std::vector<double>& observed, const std::vector<double>& expected) {
  std::vector<size_t> order(expected.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(),
            [&](size_t a, size_t b) { return expected[a] < expected[b]; });
  double statistic = 0, pooledSeen = 0, pooled = 0;
  int cells = 0;
  for (const size_t i : order) {
    pooledSeen += observed[i];
    pooled += expected[i];
    if (pooled < 5) continue;
    statistic += (pooledSeen - pooled) * (pooledSeen - pooled) / pooled;
    ++cells;
    pooledSeen = pooled = 0;
  }
  // What never filled a cell must not hold more than a handful of samples.
  if (pooledSeen > pooled + 6 * std::sqrt(pooled + 1)) return 0;
  if (cells < 2) return 1;
  return boost::math::gamma_q(0.5 * (cells - 1), 0.5 * statistic);
}

inline double sidak(double significance, int tests) {
  return 1 - std::pow(1 - significance, 1.0 / tests);
}

}  // namespace ninefold
