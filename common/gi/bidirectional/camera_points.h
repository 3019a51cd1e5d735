// camera_points.h: what one or more views look at: D ends x_1 ... x_M of M eye paths E S* D,
// stratified over the picture. Of n views each has M/n paths in a row, stratified in themselves.
// With --partition equal all are independent, as estimated_density.h needs them.
//
// A path whose first hit has several lobes follows one of them, chosen by albedo. A path that finds
// no diffuse point leaves none. So there may be fewer than M, or none at all.
//
//   radiance that a point shows in its pixel = share E(x)/pi,   share = throughput rho gain
//
// Source:  Segovia et al. 2006, section 3.1.   Threads: pure functions.   Errors: none.
#pragma once

#include <span>
#include <vector>

#include "common/base/counters.h"
#include "common/gi/eye/receivers.h"
#include "common/gi/eye/task.h"

namespace ninefold {

struct CameraPoints {
  Receivers points;          // padded
  std::vector<Vec3> shares;  // one a point

  // Sixteen of them judge what VPLs are worth: one of each sixteenth of the points, each time one
  // place further in it. Points of a Sobol' sequence at equal steps lie in one strip of the picture.
  static constexpr size_t kJudges = 16;
  size_t judges() const { return std::min(points.size(), kJudges); }
  size_t judge(size_t j) const {
    const size_t step = points.size() / std::max<size_t>(judges(), 1);
    return j * step + j % step;
  }
};

// Light sets of a frame are fewer (--interleave 16x16 at most).
inline constexpr int kMostSets = 256;

// Those of set k of a frame; count: M. k may be beyond kMostSets, for points of other uses.
CameraPoints cameraPoints(const Transport& transport, std::span<const View> views,
                          const FrameKey& frame, int k, int count, RayCounts& rays);

}  // namespace ninefold
