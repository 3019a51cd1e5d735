// discontinuity_buffer.h: folds the n x m light sets around a pixel into one estimate, without
// crossing edges.
//
//   E'(p) = E_0 + sum_i w_i (E_i - E_0) / sum_i w_i       over the n x m window around p
//
//   E_0, w_0   E of p itself; w_0 = 1
//   w_i        neighbourWeight if the surface goes on from p to i (surface_test.h), else 0
//
// Each light set comes into the window at most once. Even sizes reach one pixel further right and
// down. Near the border of the image the window has fewer pixels. A constant E comes out bit for
// bit. The sum runs row by row, so the result is the same however tiles are shared out.
//
// It works on a patch, a phase as one long row: results in the border are never looked at.
//
// Source:  Keller and Heidrich 2001; Wald et al. 2002.
// Proved:  tests/image/discontinuity_buffer_test.cpp.
// Threads: one at a time.
#pragma once

#include "common/image/surface_links.h"

namespace ninefold {

class DiscontinuityBuffer {
 public:
  explicit DiscontinuityBuffer(SurfaceTest test) : links_(test) {}

  // Finds where the surface goes on. Once for each patch, before the others.
  void prepare(const Patch& patch, const Camera& camera) { links_.connect(patch, camera); }

  // Filters E of a layer for one phase's pixels into `out`, a plane of the patch's shape.
  // neighbourWeight in [0, 1]: 1 filters fully, 0 copies.
  void filter(const Patch& patch, int layer, int phase, float neighbourWeight, RgbPlane& out) const;

  // sum_i w_i / (n m): the share of the window that filter averages over; 1 if all of it counts.
  void shares(const Patch& patch, int layer, int phase, float neighbourWeight,
              std::vector<float>& out) const;

 private:
  struct Sums;
  // Calls take(index of the first pixel, sums over the window) for each kLanes pixels.
  template <typename Take>
  void sum(const Patch& patch, int layer, int phase, float weight, const Take& take) const;

  SurfaceLinks links_;
};

}  // namespace ninefold
