// neighbour_share.h: how much of the discontinuity buffer's result a film takes. It keeps two means
// of the same frames, U of unfiltered pixels and F of fully filtered ones:
//
//   L = U + a D,   D = F - U
//   a = -<Cov(U, D)> / <D^2>, in [0, 1]    share of the neighbours
//   b^2 = max(0, <D^2> - <Var D>)           squared bias of F
//
//   Var, Cov   of the means' luminance, by their replications (replications.h)
//   < >        mean over 5x5 pixels, each divided by Y^2 + Y_0^2/100: Y luminance of F, Y_0 its mean
//
// D^2 has the mean b^2 + Var D. So U + a D has the least squared error, whatever U and F have in
// common. Where the filter blurs nothing a stays near 1, and neighbours with other light sets leave
// no pattern. Where it blurs, a falls as 1/N, and L tends to the truth as U does.
//
// Fails:   b of less than D's noise is not seen; its blur is then smaller than the noise it spares.
// Source:  James and Stein 1961 (shrinkage towards a biased estimate).
// Proved:  tests/image/neighbour_share_test.cpp.   Threads: pure.   Errors: none.
#pragma once

#include <vector>

#include "common/image/image.h"
#include "common/image/replications.h"

namespace ninefold {

struct NeighbourShare {
  std::vector<float> share;        // a in [0, 1], row-major
  std::vector<float> squaredBias;  // a^2 b^2 [luminance^2]

  // filtered: F. u, d: replications of U's and D's luminance. Below two frames a = 1.
  static NeighbourShare of(const RgbImage& filtered, const Replications<float>& u,
                           const Replications<float>& d, int64_t frames);
};

}  // namespace ninefold
