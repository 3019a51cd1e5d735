// photon_footprint.h: how much surface a photon's disk covers. At the edge of a wall or on a narrow
// board part of the disk is empty, and flux over pi r^2 would lose energy there: to first order in
// r, everywhere where walls meet. So flux is divided by
//
//   f = A/(pi r^2),   A = area of the surface that accepts the photon
//
// estimated with one packet of rays along -n through a fixed pattern on the disk, each counting
// 1/cos of its hit's normal to n. Receivers that accept the photon are those of
// caustic_photons.h: within r, normals within 60 degrees.
//
// Source:  boundary bias of density estimates: Jensen 2001, 7.6; the division conserves energy for
// each photon alone.   Proved: tests/gi (caustic energy balance; a narrow board).
// Fails:   surface that is hidden from a height of r/2 counts as none; f is known to 1/16; both go
// with r.   Threads: reentrant.   Errors: none.
#pragma once

#include "common/gi/transport.h"

namespace ninefold {

inline constexpr float kPhotonNormalCosine = 0.5f;

// f in [1/16, 2], for a photon that landed at x on the side of unit n. `turn` in [0, 1) turns the
// pattern.
float photonFootprint(const Transport& transport, Vec3 x, Vec3 n, Metres r, float turn);

}  // namespace ninefold
