// shooting.h: the photons of one unit: per-frame paths from the lamps, and what they hit.
//
//   Phi_i = Phi / total     power of a path that leaves the lamps, Phi: of all lamps [W]
//
// So the power of the whole pool is the lamps' flux at each moment, as far as paths meet something.
// (As published, only new photons are divided, by how many are shot: then each has total/per-frame
// times its power.) Where a lamp is dimmed, old photons bring its old light until they are
// replaced, P = total/per-frame units later.
//
// What is stored: hits where there is a D lobe, if the last lobe that turned the path was D or
// glossy; and what comes straight from a lamp, if direct light is the pool's (--map-direct). What
// arrives after another S lobe is the caustic photons' (photons/caustic_photons.h). Walks end by
// roulette (light/light_path.h) or where no receiver may count them (--path-length). If a unit has
// more hits than its pages have room for, n > N, every n/N-th is kept and carries n/N times as
// much: the mean stays. So nothing is lost.
//
// Distribution of the paths, j = n mod P being the part that unit n makes:
//
//   random  numbers by n, alike in no unit
//   frame   the same per-frame pseudo-random numbers for each unit
//   turn    total pseudo-random numbers, the same for each turn of the ring
//   nets    the first `total` points of one randomized Sobol' sequence; part j has the points
//           j per-frame ... (j+1) per-frame - 1. If per-frame is 2^m, a part is a (t,m,s)-net and
//           2^i aligned parts are one, too. Else a part is a run of the sequence and holds the
//           aligned nets that fit into it: of 100 points one of 32 at least.
//
// All but `random` bring the same photons again while nothing changes. Another randomization of the
// step is another set of numbers, so that states of film frames are independent.
//
// Source:  Jozwowski 2002, 4.1.1 and 4.3; `nets` was made for this project.
// Proved:  tests/gi/photon_map_test.cpp (power, order of units, path length).
// Threads: pure function.   Errors: none.
#pragma once

#include "common/base/counters.h"
#include "common/gi/light/transport.h"
#include "common/gi/photon_map/map_photon.h"

namespace ninefold {

// Hits of a unit, at most `room`, in the order of paths and hits. Adds its rays to `rays`.
std::vector<MapPhoton> shootUnit(const Transport& transport, uint32_t randomization, uint32_t unit,
                                 const MapLayout& layout, RayCounts& rays);

}  // namespace ninefold
