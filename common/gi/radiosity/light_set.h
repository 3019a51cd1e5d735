// light_set.h: the light of one interleaved set k: virtual point lights and caustic photons, a pure
// function of (scene, settings, frame's randomization, k).
//
// Source:  Keller 1997; Wald et al. 2002, section 4.
// Proved:  tests/gi (furnace, energy, order independence).
// Threads: plain data once made; making is reentrant.   Owner: shared by the tasks of a set.
#pragma once

#include "common/gi/method/method.h"
#include "common/gi/photons/caustic_photons.h"
#include "common/gi/vpl/vpl.h"

namespace ninefold {

struct LightSet final : FrameLight, VplSet {
  CausticPhotons photons;

  std::string oddValue() const override;
};

// pathsLog2: m of indirect_vpls.h.
LightSet makeLightSet(const Transport& transport, const FrameKey& frame, int k, int pathsLog2);

}  // namespace ninefold
