#include "common/gi/bidirectional/bidirectional.h"

#include "common/gi/bidirectional/light_maker.h"
#include "common/gi/vpl/indirect_vpls.h"

namespace ninefold {

Bidirectional::Bidirectional(const Transport& t, const Bidirectional* begun)
    : LightSetMethod(t),
      pathsLog2_(begun != nullptr && begun->pathsLog2_ >= 0
                     ? begun->pathsLog2_
                     : lightPathsLog2(t, t.settings.resampling * t.settings.indirectVpls)),
      standardDensity_(begun != nullptr && begun->pathsLog2_ >= 0
                           ? begun->standardDensity_
                           : std::make_shared<const StandardDensity>(t)) {}

std::shared_ptr<const FrameLight> Bidirectional::light(const FrameKey& frame, int set,
                                                       std::span<const View> views,
                                                       const MethodState*) const {
  auto light = std::make_shared<LightSet>();
  if (!t_.emitters.empty())
    LightMaker(t_, *standardDensity_, pathsLog2_, frame, set, views).make(*light);
  return light;
}

}  // namespace ninefold
