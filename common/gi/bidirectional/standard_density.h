// standard_density.h: how densely light paths leave VPLs around a place, per path, as a pilot
// tells.
//
//   s(y) = n / (pi r^2 N)     [1/m^2]
//
//   n   VPLs of the pilot's N paths within r, on the same side, normals within 60 degrees
//   r   R/20
//
// The pilot is no part of any estimate. It only decides which estimator a place belongs to
// (partition.h), so that its errors cost noise, never bias. It is the same for all frames and
// views.
//
// Source:  density estimation, Jensen 1996.   Threads: const once made.   Errors: none.
#pragma once

#include "common/gi/bidirectional/place.h"
#include "common/gi/light/transport.h"
#include "common/gi/photons/photon_grid.h"

namespace ninefold {

class StandardDensity {
 public:
  static constexpr int kPathsLog2 = 12;

  explicit StandardDensity(const Transport& transport, int pathsLog2 = kPathsLog2);
  float operator()(const Place& y) const;

 private:
  PhotonGrid pilot_;
  float scale_;  // 1/(pi r^2 N) [1/m^2]
};

}  // namespace ninefold
