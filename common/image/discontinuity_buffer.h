// discontinuity_buffer.h: folds the n x m light sets around a pixel into one estimate, without
// crossing edges.
//
//   E'(p) = E_0 + sum_i w_i (E_i - E_0) / sum_i w_i
//
//   w_0 = 1; w_i = neighbourWeight if the surface goes on from p to i (surface_test.h), else 0
//
// over the n x m window around p, so that each light set comes in at most once. Even sizes reach
// one pixel further right and down. Near the border of the image the window has fewer pixels. A
// constant E comes out bit for bit. The sum runs over the window row by row, so that the result is
// the same however tiles are shared out.
//
// Works on a patch. All its planes have the same shape, so that each position of the window is
// another phase's plane shifted by a constant, and a phase is filtered as one long row: what this
// computes in the border is never looked at.
//
// Source:  Keller and Heidrich 2001; Wald et al. 2002.
// Proved:  tests/image/discontinuity_buffer_test.cpp.
// Threads: one at a time. Memory: 4 floats per pixel of a patch, taken by the first guide().
#pragma once

#include "common/image/patch.h"
#include "common/image/surface_test.h"
#include "common/math/camera.h"

namespace ninefold {

// SurfaceGuide of each pixel of a phase.
struct GuidePlanes {
  std::vector<float> u, gradX, gradY, slack;

  void resize(size_t n) { u.resize(n), gradX.resize(n), gradY.resize(n), slack.resize(n); }
};

class DiscontinuityBuffer {
 public:
  explicit DiscontinuityBuffer(SurfaceTest test) : test_(test) {}

  // Prepares the first layer's surface test. Once for each patch.
  void guide(const Patch& patch, const Camera& camera);

  // Filters E of a layer for one phase's pixels into `out`, a plane of the patch's shape.
  // neighbourWeight in [0, 1]: 1 filters fully, 0 copies.
  void filter(const Patch& patch, int layer, int phase, float neighbourWeight, RgbPlane& out) const;

  // sum_i w_i / (n m), what filter averages over: 1 if all the window counts fully.
  void shares(const Patch& patch, int layer, int phase, float neighbourWeight,
              std::vector<float>& out) const;

 private:
  // Calls take(index of the first pixel, E_0, sums over the window) for each run of pixels.
  template <typename Take>
  void sum(const Patch& patch, int layer, int phase, float weight, const Take& take) const;

  const SurfaceTest test_;
  std::vector<GuidePlanes> guides_;  // per phase; none for the paper's test
};

}  // namespace ninefold
