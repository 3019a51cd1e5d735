// map_gather.h: irradiance from the pool.
//
//   E(x) = 1/(pi r^2 f) sum Phi_i   over the hits that x accepts, nearer than r     [W/m^2]
//   r    = distance to the m-th of them; D if there are fewer within D
//   f    part of the disk of radius r on which such hits may lie (surface_cover.h)
//
//   m    --map-nearest          D    --map-distance times R [m]
//
// x accepts a hit within D if
//   - it landed on x's side,
//   - its normal is within 60 degrees of x's,
//   - it lies within D/8 of x's tangent plane. Without this the wall behind a picture would count
//     as surface, and the picture would be too dark.
//   - its path and the eye path together have no more D vertices than allowed.
// Of equally far hits the first in page order is nearer.
//
// The m-th tells r and is not counted: if hits are spread evenly and by chance, the mean of
// (m-1)/(pi r^2) is their density, that of m/(pi r^2) m/(m-1) times it. With fewer than m within D
// all of them count; both cases together are right in the mean, too.
//
// Receivers of a task lie together. They are halved by place until groups of up to 32 are left that
// are small beside r. A group shares one search: first for the m nearest of the receiver in its
// middle, then for all hits within reach of any receiver. A receiver whose m nearest might lie
// further away searches alone. So what a receiver finds does not depend on its group. The rays that
// tell f are the group's, so that f does depend on it, by its noise.
//
// Source:  Jensen 2001, 7; Jozwowski 2002, 3.3 (m nearest within a distance). Moore and Yackel 1977
//          (m - 1). Groups: made for this project.
// Proved:  tests/gi/photon_map_test.cpp (closed forms; groups find what single searches find).
// Fails:   light is blurred over r. It leaks under walls that are thinner than that, and to floors
//          up to D/8 below a lit one.
// Threads: reentrant with one scratch a thread.   Errors: none.
#pragma once

#include "common/base/counters.h"
#include "common/gi/eye/receivers.h"
#include "common/gi/photon_map/photon_pool.h"
#include "common/gi/photon_map/surface_cover.h"

namespace ninefold {

struct MapGatherScratch {
  std::vector<uint32_t> order;  // of the receivers: those near each other together
  Nearest nearest;
  std::vector<uint32_t> names;    // hits within reach of the group, in their order
  std::vector<float> px, py, pz;  // their positions ...
  std::vector<float> nx, ny, nz;  // and normals
  std::vector<Flux> flux;
  std::vector<float> d2;  // from one receiver; infinite if it does not accept the hit
  std::vector<NearKey> keys;
  SurfaceCover cover;
};

// Adds E of the pool to receivers. pathVertices: as in layered_method.h. randomization: of the
// frame; with the receivers' pixels it turns the rays that tell f.
void gatherPool(const Transport& transport, const PhotonPool& pool, int pathVertices,
                uint32_t randomization, MapGatherScratch& scratch, Receivers& receivers,
                RayCounts& rays);

// The same, with each receiver a group by itself: E does not depend on which others there are.
void gatherPoolAlone(const Transport& transport, const PhotonPool& pool, int pathVertices,
                     uint32_t randomization, MapGatherScratch& scratch, Receivers& receivers,
                     RayCounts& rays);

}  // namespace ninefold
