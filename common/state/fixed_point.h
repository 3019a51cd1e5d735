// fixed_point.h: light as whole numbers, so that sums of it are exact in any order.
//
//   u = 2^(16 j - 40) W   with 2^(16 j) <= Phi < 2^(16 j + 16)    quantum
//   n = round(x / u)                                              a deposit x [W]
//   Phi                                                           flux of all lamps [W]
//
// A photon of Phi / 2^20 has at least 2^20 u, and a sum that has all of Phi at most 2^56 u. So a
// deposit errs by less than a millionth, and a sum has room for 2^7 times Phi. A scene whose Phi
// lies in another band has another u: its sums begin anew. Weights without unit have u = 2^-32.
//
// A deposit must be rounded once, and taken away as the same whole number.
//
// Proved:  tests/state/fixed_point_test.cpp.
// Threads: pure functions.   Errors: toFixed throws Error for what is not finite or too large.
#pragma once

#include <cmath>
#include <cstdint>

#include "common/base/error.h"

namespace ninefold {

inline constexpr double kWeightQuantum = 0x1p-32;

// j above. Phi > 0.
inline int fluxBand(double flux) { return static_cast<int>(std::floor(std::ilogb(flux) / 16.0)); }

// u [W].
inline double fluxQuantum(int band) { return std::ldexp(1.0, 16 * band - 40); }

inline int64_t toFixed(double x, double quantum) {
  const double n = std::nearbyint(x / quantum);
  if (!(std::abs(n) < 0x1p62))
    fail("a deposit of {} is too large for a state whose quantum is {}", x, quantum);
  return static_cast<int64_t>(n);
}

inline double fromFixed(int64_t n, double quantum) { return static_cast<double>(n) * quantum; }

}  // namespace ninefold
