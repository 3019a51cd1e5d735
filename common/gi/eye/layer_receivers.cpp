#include "common/gi/eye/layer_receivers.h"

#include "common/gi/eye/eye_path.h"
#include "common/gi/light/direct_light.h"

namespace ninefold {

void LayerReceivers::add(TaskContext& c, int layer, const ShadingPoint& x, size_t pixel,
                         int absorber, Reflectance throughput, float gain, float distance,
                         uint16_t chain) {
  const int i = static_cast<int>(pixel) % c.rect.width, j = static_cast<int>(pixel) / c.rect.width;
  Receiver r =
      receiverAt(x, static_cast<uint32_t>(c.pixelX(i) + c.view.width * c.pixelY(j)), absorber);
  r.gain = gain;
  of(layer).add(r);
  places_[static_cast<size_t>(layer)].push_back(static_cast<uint32_t>(pixel));
  LayerPlanes& planes = c.out.layers[static_cast<size_t>(layer)];
  put(planes.reflectance, pixel, kInvPi * throughput * x.bsdf.diffuse);
  put(planes.normal, pixel, x.ns);
  planes.distance[pixel] = distance;
  planes.chain[pixel] = chain;
}

void LayerReceivers::followLayer(TaskContext& c, const FirstHit& first, Lobe lobe,
                                 Reflectance through) {
  const int layer = lobe == Lobe::reflection ? kReflection : kTransmission;
  const uint32_t dimension = 8 + static_cast<uint32_t>(layer - 1) * eyePathDimensions(c.t.settings);
  const EyePathEnd end =
      followLobe(c.t, first.point, lobe, first.distance, through, c.view.eyeMedia,
                 c.sampler(first.x, first.y, 0), dimension, c.out.rays);
  put(c.out.layers[static_cast<size_t>(layer)].unfiltered, first.pixel, end.unfiltered);
  if (end.arrived)
    add(c, layer, end.x, first.pixel, end.absorber, end.throughput, end.gain, end.distance,
        end.chain);
}

void LayerReceivers::split(TaskContext& c, const FirstHit& first) {
  LayerPlanes& diffuse = c.out.layers[kDiffuse];
  if (!first) {
    put(diffuse.unfiltered, first.pixel, c.t.emitters.environment(first.direction));
    return;
  }
  const ShadingPoint& p = first.point;
  const Vec3 through = c.t.shader.attenuation(p, c.view.eyeMedia, first.distance);
  put(diffuse.unfiltered, first.pixel, through * emittedRadiance(c.t, p));
  if (!isBlack(p.bsdf.diffuse))
    add(c, kDiffuse, p, first.pixel, c.t.shader.absorber(p, c.view.eyeMedia), through, 1,
        first.distance, 0);
  if (p.bsdf.reflects) followLayer(c, first, Lobe::reflection, through);
  if (p.bsdf.transmits()) followLayer(c, first, Lobe::transmission, through);
}

void LayerReceivers::find(TaskContext& c) {
  for (Receivers& receivers : receivers_) receivers.clear();
  for (auto& places : places_) places.clear();
  forEachFirstHit(c, 0, [&](const FirstHit& first) { split(c, first); });
}

void LayerReceivers::putIrradiance(TaskContext& c, int layer) const {
  const auto l = static_cast<size_t>(layer);
  for (size_t i = 0; i < receivers_[l].size(); ++i)
    put(c.out.layers[l].irradiance, places_[l][i],
        receivers_[l].gain[i] * receivers_[l].irradiance(i));
}

void LayerReceivers::putCaustic(TaskContext& c, const std::vector<Irradiance>& caustic) const {
  for (size_t i = 0; i < caustic.size(); ++i)
    put(c.out.extras.caustic, places_[kDiffuse][i], caustic[i]);
}

}  // namespace ninefold
