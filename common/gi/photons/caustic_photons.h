// caustic_photons.h: photons for the last leg from an S vertex, L S+ D and ...D S+ D.
//
//   E(x) = 1/(pi r^2) sum Phi_i/f_i   over photons within r that landed on x's side, at most r/8
//                                     off x along their normal, normals within 60 degrees [W/m^2]
//
//   r   radius of the photons (photon_radii.h): wider for photons that would be bright alone,
//       narrower where they do not lie evenly, as the first thousand of a set tell
//       (photon_spread.h)                                                                    [m]
//   Phi flux / n^2 in a medium of index n                                                    [W]
//   f   area of surface that the photon's disk covers, over pi r^2 (photon_footprint.h)
//
// Photons leave the emitters aimed at the S objects (emission.h), pass through S vertices and are
// stored at the first D vertex if an S came before it. With `all`, half of them leave the set's
// indirect VPLs instead (chosen by flux, a tenth alike), aimed in the same way: VPLs are D vertices
// with every prefix, so ...D S+ D is whole. Each half of n photons is divided by n: emissions
// count, not landings.
//
// Source:  Jensen 1996.   Proved: tests/gi (caustic energy balance; no photon in a diffuse scene).
// Fails:   flux is blurred over r, which goes with r.   Threads: pure functions.
#pragma once

#include <span>

#include "common/base/counters.h"
#include "common/gi/eye/receivers.h"
#include "common/gi/photons/photon_radii.h"
#include "common/gi/vpl/vpl.h"

namespace ninefold {

// Photons of set k with these VPLs. which, count: as in the settings, or more. Adds its rays to
// `rays`.
CausticPhotons causticPhotons(const Transport& transport, const FrameKey& frame, int k,
                              std::span<const Vpl> vpls, Caustics which, int count,
                              RayCounts& rays);

// Adds the photons' irradiance to all receivers, and to `caustic`, one a receiver, if not null;
// pathVertices as in layered_method.h.
void gatherPhotons(const Transport& transport, const PhotonGrid& grid, int pathVertices,
                   Receivers& receivers, std::vector<Irradiance>* caustic);

}  // namespace ninefold
