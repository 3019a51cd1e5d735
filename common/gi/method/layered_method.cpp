#include "common/gi/method/layered_method.h"

namespace ninefold {

void LayeredMethod::render(const View& view, const Task& task, const FrameLight& light,
                           Scratch& memory, TileResult& out) const {
  auto& scratch = static_cast<LayeredScratch&>(memory);
  TaskContext c(t_, view, task, out, 1);
  scratch.layers.find(c);
  for (int layer = 0; layer < kLayers; ++layer) {
    if (!hasLayer(out.layerMask, layer)) continue;
    Receivers& receivers = scratch.layers.of(layer);
    const ReceiverSamples samples(t_.settings.seed, task.frame.randomization,
                                  static_cast<uint32_t>(layer));
    const bool wantsCaustic = layer == kDiffuse && c.wants(kCausticPlane);
    std::vector<Irradiance> caustic(wantsCaustic ? receivers.size() : 0, Irradiance(0));
    query(light, samples, 1, scratch, receivers, wantsCaustic ? &caustic : nullptr, out.rays);
    scratch.layers.putIrradiance(c, layer);
    if (wantsCaustic) scratch.layers.putCaustic(c, caustic);
  }
}

}  // namespace ninefold
