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
// the same however rows are shared out.
//
// Works on rows of one phase's sub-plane: each window position is then one row of another
// sub-plane, shifted by a constant.
//
// Source:  Keller and Heidrich 2001; Wald et al. 2002.
// Proved:  tests/image/discontinuity_buffer_test.cpp.
// Threads: guideRows for different rows at once; filterRows after guideRows of the whole window.
// Memory:  4 floats per pixel, taken by reset(); none later.
#pragma once

#include "common/image/frame_buffer.h"
#include "common/image/surface_test.h"
#include "common/math/camera.h"

namespace ninefold {

// SurfaceGuide of each pixel of a sub-plane.
struct GuidePlanes {
  std::vector<float> u, gradX, gradY, slack;

  void resize(size_t n) { u.resize(n), gradX.resize(n), gradY.resize(n), slack.resize(n); }
};

class DiscontinuityBuffer {
 public:
  void reset(const TileGrid& grid, SurfaceTest test);

  // Prepares the first layer's surface test for rows [j0, j1) of a phase. Once per frame.
  void guideRows(const FrameBuffer& frame, const Camera& camera, int phase, int j0, int j1);

  // Filters E of a layer for rows [j0, j1) of a phase into `out`, a plane of the phase's size.
  // neighbourWeight in [0, 1]: 1 filters fully, 0 copies.
  void filterRows(const FrameBuffer& frame, int layer, int phase, int j0, int j1,
                  float neighbourWeight, RgbPlane& out) const;

 private:
  // `count` pixels of row j from pixel `first` on.
  void filterChunk(const FrameBuffer& frame, int layer, int phase, int j, int first, int count,
                   float weight, RgbPlane& out) const;

  SurfaceTest test_ = SurfaceTest::surface;
  std::vector<GuidePlanes> guides_;  // per phase; none for the paper's test
};

}  // namespace ninefold
