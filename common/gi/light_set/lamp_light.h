// lamp_light.h: what methods have in common that keep bounced light elsewhere: the light that comes
// straight from lamps, and what mirrors and glass throw.
//
//   E(x) = direct VPLs with bounded geometry terms, but for lamps that are left out
//        + emission that the bound cut off: compensation with L_e alone
//        + caustic photons; those of ...D S+ D start at light-path vertices traced for that alone
//
// Threads, owner, errors: as light_set.h.
#pragma once

#include "common/gi/light/minor_lamps.h"
#include "common/gi/light_set/light_set.h"

namespace ninefold {

struct LampLightScratch : LayeredScratch {
  LightSetScratch lamps;
};

// Of set k.
void addLampLight(const Transport& transport, const FrameKey& frame, int k, LightSet& set,
                  const MinorLamps& leftOut = {});
// Caustic photons alone.
void addCausticPhotons(const Transport& transport, const FrameKey& frame, int k, LightSet& set);

// Adds E to receivers; arguments as in layered_method.h.
void gatherLampLight(const Transport& transport, const LightSet& lights,
                     const ReceiverSamples& samples, int pathVertices, LightSetScratch& scratch,
                     Receivers& receivers, std::vector<Irradiance>* caustic, RayCounts& rays,
                     const MinorLamps& leftOut = {});

}  // namespace ninefold
