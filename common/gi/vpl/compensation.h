// compensation.h: gives the bounded geometry term its lost energy back, without bias and without
// fireflies.
//
//   E(x) lacks  integral over hits y of  L(y -> x) cos_s dw  max(G - b, 0) / G
//   estimate    pi (W_e L_e(y) + W rho_y/pi E(y)),  W = max(G - b, 0) / G,  one direction w with
//               density cos_s/pi
//
//   G, b, cos_s   as in vpl_gather.h; W_e with an emitter's own b
//   E(y)          from VPLs and photons, of paths one D vertex longer, compensated in turn
//
// Short rays: W is zero beyond t = sqrt(cos_x / b), and few rays hit anything before. A hit is
// followed with probability q = min(kMaxSurvival, largest channel of W rho_y) and divided by q, as
// often as it takes: in a narrow gap all of the light comes this way. The number xi that decides,
// xi < q, is drawn before the ray. As q <= W <= 1 - b t^2/cos_x, no hit beyond
// sqrt((1-xi) cos_x / b) can be followed, and the ray ends there. The emission of a hit is divided
// by the probability 1 - b t^2/cos_x of a ray that long.
//
// A glossy lobe of y (needs.h) is chosen by another part of the numbers xi below 1 - b t^2/cos_x.
// An eye path goes on from there, and brings what it meets, and E at its end, times W. Light that
// is not bounded at x (punctual lights, environment, photons) lacks nothing: rays that meet
// nothing, and other S lobes at y, return nothing.
//
// Source:  Kollig and Keller, "Illumination in the Presence of Weak Singularities", 2004.
// Proved:  tests/gi (furnace in a corner and in a slit: exact with it, too dark without; agreement
//          with the path tracer).
// Threads: reentrant with one scratch a thread.   Errors: none; at most kMaxVertices levels.
#pragma once

#include <deque>
#include <functional>
#include <vector>

#include "common/base/counters.h"
#include "common/gi/eye/receiver_samples.h"
#include "common/gi/eye/receivers.h"
#include "common/gi/light/minor_lamps.h"
#include "common/gi/light/transport.h"

namespace ninefold {

// What one level's rays met. `factor` times its irradiance goes to `receiver`.
struct Bounces {
  struct Parent {
    size_t receiver;
    Vec3 factor;
  };
  Receivers points;
  std::vector<Parent> parents;

  void clear() { points.clear(), parents.clear(); }
};

using CompensationScratch = std::deque<Bounces>;  // one level a bounce, as deep as it ever went

// Adds E(y) to receivers whose paths have `pathVertices` D vertices. E(y) is compensated in turn.
using IrradianceQuery = std::function<void(int pathVertices, Receivers& receivers)>;

// What short rays bring back: all, or some of it where the rest is somebody else's.
struct CompensationParts {
  bool emission = true;  // W_e L_e
  bool onward = true;    // W rho_y/pi E(y)
  bool glossy = true;    // what a glossy lobe of y sends
  // Lamps without virtual lights lack nothing. Null: each lamp has some.
  const MinorLamps* leftOut = nullptr;
};

// Adds compensation to receivers.er/eg/eb. pathVertices as in layered_method.h.
void compensate(const Transport& transport, const ReceiverSamples& samples, int pathVertices,
                CompensationParts parts, CompensationScratch& scratch, Receivers& receivers,
                RayCounts& rays, const IrradianceQuery& irradiance);

}  // namespace ninefold
