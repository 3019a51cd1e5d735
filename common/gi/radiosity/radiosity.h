// radiosity.h: instant radiosity. VPLs stand on the lamps and at the D vertices of light paths; the
// set is a pure function of (scene, settings, frame's randomization, k).
//
// Source:  Keller 1997; Wald et al. 2002, section 4.
// Threads, owner, errors: as method.h says.
#pragma once

#include "common/gi/light_set/light_set_method.h"

namespace ninefold {

// pathsLog2: m of indirect_vpls.h; -1: no path is needed.
LightSet makeLightSet(const Transport& transport, const FrameKey& frame, int k, int pathsLog2);

class Radiosity final : public LightSetMethod {
 public:
  // `begun`: of the scene that a gesture began with, null at rest; m stays as it is there.
  Radiosity(const Transport& transport, const Radiosity* begun);

  std::shared_ptr<const FrameLight> light(const FrameKey& frame, int set,
                                          std::span<const View> views,
                                          const MethodState* state) const override;

 private:
  const int pathsLog2_;  // m of indirect_vpls.h
};

}  // namespace ninefold
