// partition.h: which estimator a path belongs to whose last D vertex before the receiver is y.
//
//   w_s(y) + w_r(y) = 1,   w_r = N_r q / (N_r (q + q_0) + N_s s)
//
//   N_r, q   reverse rays of the set, and the density of their ends                  [1/m^2]
//   N_s, s   light paths of the set, and a guess how densely each leaves VPLs        [1/m^2]
//   q_0      1/(4 pi R^2): places that hardly any camera point sees, by chance, have a tiny q.
//            What the rays find there would be so bright that it shows as a spot in pixels near by.
//            So the light paths keep them.                                           [1/m^2]
//
// Proof that nothing is lost or counted twice. Given the camera points, both are functions of the
// place alone. The irradiance at any point x by way of y is the integral of g(y) over all places,
// g(y) = V G(x, y) rho/pi E(y) dA. Standard VPLs estimate the integral of f g for every function f
// when their power is multiplied by f(y): take f = w_s. Reverse VPLs have density N_r q, so that
// w_r/(N_r q) rho/pi E(y) estimates the integral of w_r g wherever q > 0; where q = 0, w_r = 0. The
// sum of both is the integral of g. It holds for every x, seen by the camera or not, and for every
// s: a poor guess costs noise only. E(y) may be any unbiased estimate that does not depend on which
// y were drawn (raw_light.h). Guesses of E(y) decide what is kept. They have random numbers of
// their own, so that the exact E(y) of what is kept has the right mean.
//
// --partition equal is the published form: w_s = w_r = 1/2 where q > 0. Its q is an estimate, with a
// proof of its own: estimated_density.h.
//
// VPLs on lamps keep w_s = 1: reverse VPLs carry no emission. So do glossy lobes.
//
// Proved:  tests/gi (furnace, form factors, agreement with the path tracer; keyhole).
// Source:  balance heuristic, Veach and Guibas 1995, over places; the two families: Segovia et al.
//          2006, section 3.2.
// Threads: const, reentrant.   Errors: none.
#pragma once

#include "common/gi/bidirectional/reverse_density.h"
#include "common/gi/bidirectional/standard_density.h"

namespace ninefold {

struct Partition {
  const Transport& t;
  const Receivers& cameraPoints;
  const StandardDensity& standardDensity;
  double paths;  // N_s
  double shot;   // N_r

  bool isEqual() const { return t.settings.partition == PartitionRule::equal; }

  double standardCount(const Place& y) const {
    const double hardlySeen = 1 / (4 * double{kPi} * double{t.radius} * double{t.radius});
    return shot * hardlySeen + paths * double{standardDensity(y)};
  }

  // w_s for a density q at y.
  float standardShare(const Place& y, float q) const {
    if (q <= 0) return 1;
    if (isEqual()) return 0.5f;
    const double standard = standardCount(y);
    return static_cast<float>(standard / (standard + shot * double{q}));
  }
  // w_r/(N_r q) at a place that a ray was drawn to [m^2]. Rounding may make q = 0 there.
  float reverseArea(const Place& y, float q) const {
    if (q <= 0) return 0;
    if (isEqual()) return static_cast<float>(0.5 / (shot * double{q}));
    return static_cast<float>(1 / (standardCount(y) + shot * double{q}));
  }
};

}  // namespace ninefold
