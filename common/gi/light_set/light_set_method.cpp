#include "common/gi/light_set/light_set_method.h"

namespace ninefold {
namespace {

struct MethodScratch final : LayeredScratch {
  LightSetScratch gather;
};

}  // namespace

std::unique_ptr<Scratch> LightSetMethod::makeScratch() const {
  return std::make_unique<MethodScratch>();
}

void LightSetMethod::query(const FrameLight& light, const ReceiverSamples& samples,
                           int pathVertices, LayeredScratch& scratch, Receivers& receivers,
                           std::vector<Irradiance>* caustic, RayCounts& rays) const {
  const auto& lights = static_cast<const LightSet&>(light);
  gatherLightSet(lights.transport != nullptr ? *lights.transport : t_, lights, samples,
                 pathVertices, static_cast<MethodScratch&>(scratch).gather, receivers, caustic,
                 rays);
}

}  // namespace ninefold
