// surface_cover.h: how much surface lies around points that are near each other: what part of a
// disk around x may be hit by photons that count at x. At the edge of a wall part of the disk is
// empty, and flux over pi r^2 alone would lose energy there.
//
//   f(x, r) = sum 1/cos_j over what rays met within r of x / number of rays through x's disk
//
// The rays go along -n through a pattern on one disk that covers those of all the points: 32
// through the smallest. Each counts where it first meets a surface that accepts photons, as far off
// x's tangent plane as photons may be: what lies below that (a floor under a carpet, a wall behind
// a picture) gets no light. cos_j: between n and the normal that was met. So f is exactly 1 in the
// middle of a plane.
//
// Source:  boundary bias of density estimates: Jensen 2001, 7.6; shared rays were made for this
//          project (one set of rays for each x took a third of the time of a picture).
// Proved:  tests/gi/photon_map_test.cpp (a wall's edges, a narrow board, a picture on a wall).
// Fails:   f is known to some percent where a disk is not whole. A thing alone in its disk that is
//          smaller than a sixth of r counts as one ray: it is too dark.
// Threads: one thread's.   Errors: none.
#pragma once

#include <vector>

#include "common/base/counters.h"
#include "common/gi/light/transport.h"

namespace ninefold {

inline constexpr float kMapNormalCosine = 0.5f;  // at least, between a receiver's and a photon's

class SurfaceCover {
 public:
  // Points within `spread` of `centre`, whose disks have radii `least` to `most`. height: how far
  // off x's tangent plane photons may be. turn in [0, 1) turns the pattern. Adds its rays to the
  // photon rays.
  struct Disks {
    Vec3 centre{0}, normal{0};
    Metres spread = 0, least = 0, most = 0, height = 0;
    float turn = 0;
    uint32_t own = ~0u;   // instance that the points lie on ...
    bool turned = false;  // ... and whether it is seen from its back
  };
  void shoot(const Transport& transport, const Disks& disks, RayCounts& counts);

  // f for x with geometric normal n; at least what one ray counts.
  float share(Vec3 x, Vec3 n, Metres r) const;

 private:
  struct Met {
    Vec3 position{0}, normal{0};
    float area = 0;  // 1/cos
  };
  void tracePacket(const Transport& t, size_t first, RayCounts& counts);
  // Whether it accepts photons.
  bool meet(const Transport& t, size_t ray, const Hit& hit);

  Disks disks_;
  std::vector<Vec3> through_;  // the pattern
  std::vector<Met> met_;
};

}  // namespace ninefold
