// surface_links.h: between which neighbours in a patch the surface goes on (surface_test.h).
//
// The test is symmetric, so a pair of pixels is tested once and both look it up: at the upper
// pixel, in a row at the left one. Each pixel has a bit for each pair (dx, dy) that begins there.
//
// All planes of a patch have the same shape. So a neighbour is another phase's plane shifted by a
// constant, and a phase is tested as one long row. In the border there is no neighbour, and the
// results there are never looked at.
//
// Proved:  tests/image/discontinuity_buffer_test.cpp.
// Threads: one at a time.   Memory: 4 floats and some words per pixel, taken by the first patch.
#pragma once

#include "common/image/patch.h"
#include "common/image/surface_test.h"
#include "common/math/camera.h"

namespace ninefold {

class SurfaceLinks {
 public:
  explicit SurfaceLinks(SurfaceTest test) : test_(test) {}

  // Tests all pairs in the layers that are not dark.
  void connect(const Patch& patch, const Camera& camera);

  // A position of the n x m window as seen from one phase. `phase` lies there; pixel i of the
  // centre's plane has pixel i + shift of that phase's plane as neighbour.
  struct Neighbour {
    int phase, shift;
    int linkPhase, linkAt;  // the surface goes on: links(layer, linkPhase)[linkAt + i] & linkBit
    uint32_t linkBit;
  };
  // Row by row, without the pixel itself; none if no neighbour ever passes the test.
  const std::vector<Neighbour>& neighbours(int phase) const {
    return neighbours_[static_cast<size_t>(phase)];
  }
  const uint32_t* links(int layer, int phase) const {
    return links_[static_cast<size_t>(layer)][static_cast<size_t>(phase)].data();
  }

 private:
  struct GuidePlanes {  // SurfaceGuide of each pixel of a phase
    std::vector<float> u, gradX, gradY, slack;
    void resize(size_t n) { u.resize(n), gradX.resize(n), gradY.resize(n), slack.resize(n); }
  };
  struct Pair {  // of a pixel of one phase and one to the right or below
    int phase, other, shift, linkAt;
    uint32_t linkBit;
    float dx, dy;
  };
  void open(Interleave pattern);
  void guide(const Patch& patch, const Camera& camera);
  void test(const Patch& patch, int layer, const Pair& pair);

  const SurfaceTest test_;
  Interleave pattern_{0, 0};
  std::vector<Pair> pairs_;
  std::vector<std::vector<Neighbour>> neighbours_;                 // by phase
  std::vector<GuidePlanes> guides_;                                // of the first layer, by phase
  std::array<std::vector<std::vector<uint32_t>>, kLayers> links_;  // by phase
};

}  // namespace ninefold
