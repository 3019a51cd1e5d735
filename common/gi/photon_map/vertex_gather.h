// vertex_gather.h: irradiance from the pool, found at the vertices of a finer mesh and carried from
// there to the points between (Gouraud):
//
//   E(x) = sum w_k E(v_k)
//   v_k, w_k   the three vertices around x, on x's side; barycentrics of x
//
// E(v): that of map_gather.h at the vertex, found by itself, not in a group; its rays are turned by
// the vertex's number. So it is a function of pages, randomization and vertex, whoever asks first.
//
// Only vertices around what the picture shows are asked for. So faces that are turned away, or
// hidden, or beyond the picture, cost nothing: as published, "back faces culled", and more.
//
// Source:  Jozwowski 2002, 4.1.3 (estimates at vertices), 4.4 (culling, corners).
// Proved:  tests/gi/vertex_gather_test.cpp (linear light is exact; the estimate tends to that at
//          pixels).
// Fails:   as map_gather.h; and light and shadow finer than the mesh are lost. A vertex that is
//          under a thing or behind a wall brings what is there into the triangles around it.
// Threads: reentrant with one scratch a thread.   Errors: none.
#pragma once

#include "common/gi/photon_map/map_gather.h"
#include "common/gi/photon_map/map_vertices.h"
#include "common/gi/photon_map/vertex_light.h"

namespace ninefold {

struct VertexGatherScratch {
  std::vector<MapVertices::Around> around;  // of the receivers
  std::vector<uint32_t> missing;            // entries
  Receivers points;                         // they
};

// Adds E of the pool to receivers that the eye sees, and to `light` what was missing there.
// `light`: of this pool, randomization and these vertices alone. Other arguments: map_gather.h.
void gatherAtVertices(const Transport& transport, const PhotonPool& pool,
                      const MapVertices& vertices, VertexLight& light, uint32_t randomization,
                      MapGatherScratch& gather, VertexGatherScratch& scratch, Receivers& receivers,
                      RayCounts& rays);

}  // namespace ninefold
