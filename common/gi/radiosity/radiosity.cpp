#include "common/gi/radiosity/radiosity.h"

#include "common/gi/vpl/indirect_vpls.h"

namespace ninefold {

LightSet makeLightSet(const Transport& t, const FrameKey& frame, int k, int pathsLog2) {
  LightSet set;
  if (t.emitters.empty()) return set;
  addStandardVpls(t, frame, k, 1, pathsLog2, set);
  set.photons =
      causticPhotons(t, frame, k, set.vpls, t.settings.caustics, t.settings.photons, set.rays);
  return set;
}

Radiosity::Radiosity(const Transport& t, const Radiosity* begun)
    : LightSetMethod(t),
      pathsLog2_(begun != nullptr && begun->pathsLog2_ >= 0
                     ? begun->pathsLog2_
                     : lightPathsLog2(t, t.settings.indirectVpls)) {}

std::shared_ptr<const FrameLight> Radiosity::light(const FrameKey& frame, int set,
                                                   std::span<const View>,
                                                   const MethodState*) const {
  return std::make_shared<const LightSet>(makeLightSet(t_, frame, set, pathsLog2_));
}

}  // namespace ninefold
