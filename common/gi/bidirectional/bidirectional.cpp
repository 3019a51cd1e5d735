#include "common/gi/bidirectional/bidirectional.h"

#include "common/gi/bidirectional/light_maker.h"
#include "common/gi/vpl/indirect_vpls.h"

namespace ninefold {

Bidirectional::Bidirectional(const Transport& t, const Bidirectional* begun)
    : LightSetMethod(t),
      isGesture_(begun != nullptr),
      pathsLog2_(begun != nullptr && begun->pathsLog2_ >= 0
                     ? begun->pathsLog2_
                     : lightPathsLog2(t, t.settings.resampling * t.settings.indirectVpls)),
      standardDensity_(begun != nullptr && begun->pathsLog2_ >= 0
                           ? begun->standardDensity_
                           : std::make_shared<const StandardDensity>(t)) {}

ViewChoice Bidirectional::choiceFor(const FrameKey& frame, std::span<const View> views) const {
  const ViewChoice byMethod{nullptr, standardDensity_, pathsLog2_};
  const bool moves = isGesture_ || !frame.lightCameras.empty();
  return moves ? byMethod : choices_.of(t_, byMethod, views.front());
}

std::shared_ptr<const FrameLight> Bidirectional::light(const FrameKey& frame, int set,
                                                       std::span<const View> views,
                                                       const MethodState*) const {
  auto light = std::make_shared<LightSet>();
  if (t_.emitters.empty()) return light;
  const ViewChoice choice = choiceFor(frame, views);
  light->transport = choice.transport;
  const Transport& t = choice.transport != nullptr ? *choice.transport : t_;
  Batch batch{0, batchesLog2(t.settings)};
  for (; batch.index < batch.count(); ++batch.index)
    LightMaker(t_, choice, batch, frame, set, views).make(*light);
  return light;
}

}  // namespace ninefold
