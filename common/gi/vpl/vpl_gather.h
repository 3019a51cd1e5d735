// vpl_gather.h: irradiance at many receivers from the virtual point lights of one light set.
//
//   E(x) = sum_i V(x, y_i) (Phi_i/pi) min(G, b) cos_s/cos_x        surface VPLs [W/m^2]
//          + sum_i V I_i(w) cos_s / d^2                            point, spot, goniometric lights
//          + sum_i V E0_i cos_s                                    directional lights
//          + sum_i V Phi_i A_i min(G, b) cos_s/cos_x               glossy lobes (glossy_vpl.h)
//
//   G       cos_x cos_y / d^2 with geometric normals               [1/m^2]
//   b       bound of G: the energy above it is missing here; compensation gives it back [1/m^2].
//           c/R^2, on small emitters more: see Transport::lightBound
//   cos_s   cosine at x with the shading normal; both cosines at x must be positive
//   V       1 if the segment is free (one shadow ray), between origins moved off the two surfaces
//
// In an absorbing solid each term is attenuated over d, as shading.h says.
//
// First come the factors without V (vpl_weights.h), then the choice of VPLs that are worth a ray
// (vpl_roulette.h), then the rays: VPL by VPL, sixteen receivers a packet. Lanes without
// contribution cast no ray. Each receiver's sum runs in the VPLs' order.
//
// Source:  Keller 1997; Wald et al. 2002.
// Proved:  tests/gi (plates, polygon light, bound only takes away).
// Threads: reentrant with one scratch a thread.
// Errors:  none; a receiver on a VPL (d = 0) gets nothing from it.
#pragma once

#include "common/gi/vpl/vpl_roulette.h"

namespace ninefold {

struct VplGatherScratch {
  VplWeights weights;
  VplRoulette roulette;
  RayPacket rays;

  VplGatherScratch() {
    for (size_t lane = 0; lane < kPacket; ++lane) rays.set(lane, Vec3(0), Vec3(0), 0, 0);
  }
};

// Adds to receivers.er/eg/eb; receivers must be padded to kPacket. Leaves out VPLs whose path would
// exceed the limit on D vertices; pathVertices as in layered_method.h. roulette: f of
// vpl_roulette.h. `shadowRays` counts active lanes.
void gatherVpls(const Transport& transport, const VplSet& lights, const ReceiverSamples& samples,
                int pathVertices, float roulette, VplGatherScratch& scratch, Receivers& receivers,
                uint64_t& shadowRays);

// The same for one VPL of the set, without roulette. For few receivers: they are one chunk.
void gatherOneVpl(const Transport& transport, const VplSet& lights, const Vpl& vpl,
                  int pathVertices, VplGatherScratch& scratch, Receivers& receivers,
                  uint64_t& shadowRays);

}  // namespace ninefold
