// light_set.h: the light of one interleaved set, as virtual point lights and caustic photons, and
// what it brings to points.
//
//   E(x) = VPLs with bounded geometry terms (vpl_gather.h)
//        + caustic photons (caustic_photons.h)
//        + what the bound cut off (compensation.h), from E one D vertex further, in turn
//
// Which VPLs and photons there are is the method's own affair. A method is unbiased if its VPLs
// are, for points anywhere in the scene.
//
// Source:  Keller 1997; Wald et al. 2002, section 4; Kollig and Keller 2004.
// Proved:  tests/gi (furnace, energy, order independence).
// Threads: a set is plain data once made; gathering is reentrant with one scratch a thread.
// Owner:   shared by the tasks of a set.   Errors: none.
#pragma once

#include "common/gi/method/layered_method.h"
#include "common/gi/photons/caustic_photons.h"
#include "common/gi/vpl/compensation.h"
#include "common/gi/vpl/vpl_gather.h"

namespace ninefold {

struct LightSet : FrameLight, VplSet {
  CausticPhotons photons;
  // Of which its VPLs are, if lamps are chosen otherwise than the method's transport says; or null.
  std::shared_ptr<const Transport> transport;

  std::string oddValue() const override;
};

struct LightSetScratch {
  VplGatherScratch vplGather;
  CompensationScratch compensation;
};

// Adds the VPLs that instant radiosity makes for set k, `times` as many direct ones as the settings
// say. pathsLog2: m of indirect_vpls.h; -1: no path is needed.
void addStandardVpls(const Transport& transport, const FrameKey& frame, int k, int times,
                     int pathsLog2, LightSet& set);

// Adds E to receivers, without what the bound cut off; arguments as in layered_method.h.
void gatherBounded(const Transport& transport, const LightSet& lights,
                   const ReceiverSamples& samples, int pathVertices, LightSetScratch& scratch,
                   Receivers& receivers, std::vector<Irradiance>* caustic, RayCounts& rays);

// Adds E to receivers; arguments as in layered_method.h.
void gatherLightSet(const Transport& transport, const LightSet& lights,
                    const ReceiverSamples& samples, int pathVertices, LightSetScratch& scratch,
                    Receivers& receivers, std::vector<Irradiance>* caustic, RayCounts& rays);

}  // namespace ninefold
