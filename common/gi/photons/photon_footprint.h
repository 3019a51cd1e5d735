// photon_footprint.h: how much surface a photon's disk covers. At the edge of a wall or on a narrow
// board part of the disk is empty. Flux over pi r^2 would lose energy there, to first order in r
// wherever walls meet. So flux is divided by
//
//   f = A/(pi r^2),   A = area of the surface that accepts the photon
//
// Receivers accept a photon within r, at most r/8 off its tangent plane, with normals within 60
// degrees, and only with a D lobe: not clear glass or bare metal. A packet of rays along -n
// through a fixed pattern on the disk, from r/8 above it to r/8 below, estimates f. Each counts
// 1/cos of the normal to n where it first meets what accepts the photon: what lies below that (a
// wall behind a lamp, a floor under a carpet) is not seen, and takes no share of the light.
//
// Source:  boundary bias of density estimates: Jensen 2001, 7.6; the division conserves energy for
//          each photon alone.
// Proved:  tests/gi (caustic energy balance; a narrow board, layers, glass).
// Fails:   f is known to 1/16; other meshes' sheets that are wound the wrong way do not count. Both
//          go with r. What lies less than r/8 under a sheet gets the sheet's caustic where it looks
//          out from under it.
// Threads: reentrant.   Errors: none.
#pragma once

#include "common/base/counters.h"
#include "common/gi/light/transport.h"

namespace ninefold {

inline constexpr float kPhotonNormalCosine = 0.5f;
inline constexpr float kPhotonHeight = 0.125f;  // [r] off the photon's tangent plane

// f >= 1/16 for a photon that landed at `at`. `turn` in [0, 1) turns the pattern. Adds its
// rays to the photon rays.
float photonFootprint(const Transport& transport, const ShadingPoint& at, Metres r, float turn,
                      RayCounts& counts);

}  // namespace ninefold
