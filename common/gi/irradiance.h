// irradiance.h: E at all receivers of a layer: VPLs, caustic photons and compensation, each counted
// once.
//
// Threads: reentrant with one scratch a thread.   Errors: none.
#pragma once

#include "common/gi/compensation.h"

namespace ninefold {

// Fills receivers.er/eg/eb. `pathVertices`: D vertices from the eye up to these receivers, they
// included. caustic: if not null, receives the photons' part for each receiver.
void gatherIrradiance(const Transport& transport, const LightSet& lights,
                      const ReceiverSamples& samples, int pathVertices, Scratch& scratch,
                      Receivers& receivers, std::vector<Irradiance>* caustic, RayCounts& rays);

}  // namespace ninefold
