// photon_spread.h: whether a lamp's photons lie evenly around one of them. Where they do not, there
// is a rim, a line or a point of focus nearer than r, which a disc of r would blur.
//
//   S = sum Phi_i     over the lamp's photons within r that landed on the same side, normals within
//                     60 degrees                                                          [W]
//   m = sum Phi_i u_i / S,   s^2 = 2 (sum Phi_i u_i^2 / S - m^2),   u_i = offset / r
//
//   s^2 = 1 evenly spread; 1 - 2 (4/(3 pi))^2 = 0.64 at a straight rim; 2/3 on a line; 0 in a point
//
// They count as uneven if s^2 < 3/4 and S >= 5 Phi. Chance alone makes patterns of fewer; and a
// photon with more than a fifth of S stays wide.
//
// Only photons of the same lamp count, so that what a gesture does to another lamp changes nothing
// (light_streams.h). Photons from VPLs take no part: they come in clumps, one for each VPL, and a
// clump is no rim (with them the relMSE of conference after 64 frames is 0.0061, not 0.0028).
//
// Source:  sample-point adaptive kernels, Breiman, Meisel, Purcell 1977 and Abramson 1982; the
//          measure of evenness was made for this project. Tried beside it: docs/performance.md.
// Proved:  tests/gi/photon_spread_test.cpp.
// Threads: const after the last add.   Errors: none.
#pragma once

#include <array>
#include <vector>

#include "common/math/units.h"

namespace ninefold {

class PhotonSpread {
 public:
  struct Landing {
    Vec3 position{0};
    Vec3 normal{0};  // unit, on the side where it landed
    float flux = 0;  // Phi [W]
    uint32_t lamp = 0;
  };
  void add(const Landing& landing);
  // Whether the photons of at.lamp within r of `at` lie unevenly, as above.
  bool isUneven(const Landing& at, Metres r) const;

 private:
  static constexpr size_t kLanes = 16;
  struct Packet {
    std::array<float, kLanes> px{}, py{}, pz{}, nx{}, ny{}, nz{}, flux{};
    std::array<uint32_t, kLanes> lamp{};
  };
  struct Sums {
    std::array<float, kLanes> flux{}, x{}, y{}, z{}, squares{};
  };
  static void addNear(const Packet& packet, const Landing& at, Metres r, Sums& sums);

  std::vector<Packet> packets_;
  size_t count_ = 0;
};

}  // namespace ninefold
