// estimated_density.h: density of the places y where rays from camera points end, as published:
// each ray starts at a camera point of its own, so that the density is not known, but estimated.
//
//   q(y) = 1/M (p(x, y) + sum_{i=1..M-1} p(x_i, y)),   p(x, y) = V(x, y) cos_x cos_y / (pi d^2)
//
//   x    the camera point whose ray ended at y: it is among the M, so that q > 0
//   x_i  M - 1 others, the same for all y of a set; four where a guess will do     [1/m^2]
//
// It is for --partition equal (partition.h): 1/2 and 1/2 where q > 0, all to the standard family
// where q = 0. For standard VPLs q has M points, too, but no x. All points are independent, so that
// x could be any one of the M. Given the M points, y has density q, and
//
//   E 1/2 g(y)/q(y) = 1/2 integral of g P,   P(y): probability that one of M points sees y
//
// Standard VPLs bring the integral of g (1 - P/2). So nothing is lost, however small M is. With
// stratified points 0.7 % of the test's light are lost for M = 50, 1.1 % for M = 5. The published
// form leaves x out: 1/q is then biased, and infinite where q = 0.
//
// Source:  Segovia et al. 2006, sections 3.1 and 4.2 (M = 50, 5 for the guess).
// Proved:  tests/gi/partition_test.cpp.
// Threads: const once made.   Errors: none.
#pragma once

#include "common/gi/bidirectional/camera_points.h"
#include "common/gi/bidirectional/reverse_places.h"

namespace ninefold {

class EstimatedDensity {
 public:
  // Of set k of a frame. `shot`: rays.
  EstimatedDensity(const Transport& transport, std::span<const View> views, const FrameKey& frame,
                   int k, int shot, RayCounts& rays);

  // Where the rays start.
  const Receivers& origins() const { return origins_.points; }
  // y: drawn from origins().
  float at(const ReversePlace& y, RayCounts& rays) const { return with(others_.points, y, rays); }
  float guess(const ReversePlace& y, RayCounts& rays) const { return with(few_.points, y, rays); }

 private:
  float with(const Receivers& others, const ReversePlace& y, RayCounts& rays) const;

  const Transport& t_;
  const CameraPoints origins_, others_, few_;
};

}  // namespace ninefold
