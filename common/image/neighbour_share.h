// neighbour_share.h: how much of the discontinuity buffer's result a film takes. It keeps two means
// of the same frames, U of unfiltered pixels and F of fully filtered ones:
//
//   L = U + a D,   D = F - U
//   a = V / (V + b^2)                       share of the neighbours; 1 below kFirst frames
//   V = <Var D>   b^2 = max(0, <D^2> - c V) squared bias of F
//
//   Var D   squared standard error of D's luminance (replications.h)
//   < >     mean over (2n - 1) x (2m - 1) pixels with weights (n - |i|)(m - |j|), so that all light
//           sets of the n x m pattern count alike; each pixel divided by Y^2 + Y_0^2/100
//   Y, Y_0  luminance of F there, and in the mean
//
// D^2 has the mean b^2 + V. Where the noise of the neighbours is independent of the pixel's own,
// U + a D has the least squared error. Where the filter blurs nothing a stays 1, so that no pattern
// of the light sets shows. Where it blurs, V falls as 1/N, a with it, and L tends to the truth.
//
// c = 2: all pixels of a set err together, so that < > sees about n m independent values of D. By
// chance their D^2 exceeds V in every second place, and the pattern would show there.
//
// Fails:   b^2 of less than (c - 1) V is not seen; its blur is then of the noise that is left.
// Source:  James and Stein 1961 (shrinkage).
// Proved:  tests/image/neighbour_share_test.cpp, neighbour_share_window_test.cpp.
// Measured: docs/performance.md.
// Threads: pure.   Errors: none.
#pragma once

#include <vector>

#include "common/image/image.h"
#include "common/image/replications.h"
#include "common/sampling/interleave.h"

namespace ninefold {

struct NeighbourShare {
  static constexpr int64_t kFirst = 4;

  std::vector<float> share;        // a in [0, 1], row-major
  std::vector<float> squaredBias;  // a^2 b^2 [luminance^2]

  // filtered: F. shift: replications of D's luminance. frames: N. pattern: n x m.
  static NeighbourShare of(const RgbImage& filtered, const Replications<float>& shift,
                           int64_t frames, Interleave pattern);
};

}  // namespace ninefold
