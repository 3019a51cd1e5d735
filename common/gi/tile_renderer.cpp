#include "common/gi/tile_renderer.h"

#include "common/gi/direct_light.h"
#include "common/gi/eye_path.h"
#include "common/gi/first_hits.h"
#include "common/gi/irradiance.h"
#include "common/gi/path_tracer.h"
#include "common/gi/reference_task.h"

namespace ninefold {
namespace {

void addReceiver(TaskContext& c, int layer, const ShadingPoint& x, size_t pixel, int absorber,
                 Reflectance throughput, float gain, float distance, uint16_t chain) {
  Receiver r;
  r.position = x.surface.position, r.ng = x.ng, r.ns = x.ns;
  r.origin = offsetOrigin(x.surface, x.ng);
  r.gain = gain, r.absorber = absorber;
  const int i = static_cast<int>(pixel) % c.rect.width, j = static_cast<int>(pixel) / c.rect.width;
  r.pixel = static_cast<uint32_t>(c.pixelX(i) + c.view.width * c.pixelY(j));
  c.scratch.receivers[static_cast<size_t>(layer)].add(r);
  c.scratch.places[static_cast<size_t>(layer)].push_back(static_cast<uint32_t>(pixel));
  LayerPlanes& planes = c.out.layers[static_cast<size_t>(layer)];
  put(planes.reflectance, pixel, kInvPi * throughput * x.bsdf.diffuse);
  put(planes.normal, pixel, x.ns);
  planes.distance[pixel] = distance;
  planes.chain[pixel] = chain;
}

void followLayer(TaskContext& c, const FirstHit& first, Lobe lobe, Reflectance through) {
  const int layer = lobe == Lobe::reflection ? kReflection : kTransmission;
  const uint32_t dimension = 8 + static_cast<uint32_t>(layer - 1) * eyePathDimensions(c.t.settings);
  const EyePathEnd end =
      followLobe(c.t, first.point, lobe, first.distance, through, c.view.eyeMedia,
                 c.sampler(first.x, first.y, 0), dimension, c.out.rays);
  put(c.out.layers[static_cast<size_t>(layer)].unfiltered, first.pixel, end.unfiltered);
  if (end.arrived)
    addReceiver(c, layer, end.x, first.pixel, end.absorber, end.throughput, end.gain, end.distance,
                end.chain);
}

// Splits the path into its layers.
void split(TaskContext& c, const FirstHit& first) {
  LayerPlanes& diffuse = c.out.layers[kDiffuse];
  if (!first) {
    put(diffuse.unfiltered, first.pixel, c.t.emitters.environment());
    return;
  }
  const ShadingPoint& p = first.point;
  const Vec3 through = c.t.shader.attenuation(p, c.view.eyeMedia, first.distance);
  put(diffuse.unfiltered, first.pixel, through * emittedRadiance(c.t, p));
  if (!isBlack(p.bsdf.diffuse))
    addReceiver(c, kDiffuse, p, first.pixel, c.t.shader.absorber(p, c.view.eyeMedia), through, 1,
                first.distance, 0);
  if (p.bsdf.reflects) followLayer(c, first, Lobe::reflection, through);
  if (p.bsdf.transmits()) followLayer(c, first, Lobe::transmission, through);
}

void gatherLayer(TaskContext& c, int layer) {
  Receivers& receivers = c.scratch.receivers[static_cast<size_t>(layer)];
  const std::vector<uint32_t>& places = c.scratch.places[static_cast<size_t>(layer)];
  LayerPlanes& planes = c.out.layers[static_cast<size_t>(layer)];
  const Settings& s = c.t.settings;
  const ReceiverSamples samples(s.seed, c.task.frame.randomization, static_cast<uint32_t>(layer));
  const bool wantsCaustic = layer == kDiffuse && c.wants(kCausticPlane);
  std::vector<Irradiance> caustic(wantsCaustic ? receivers.size() : 0, Irradiance(0));
  gatherIrradiance(c.t, c.lights, samples, 1, c.scratch, receivers,
                   wantsCaustic ? &caustic : nullptr, c.out.rays);
  for (size_t i = 0; i < receivers.size(); ++i) {
    put(planes.irradiance, places[i], receivers.gain[i] * receivers.irradiance(i));
    if (wantsCaustic) put(c.out.extras.caustic, places[i], caustic[i]);
  }
}

// Instant radiosity: eye paths to their layers' receivers, then the set's light for all of them.
void radiosityTask(TaskContext& c) {
  for (Receivers& receivers : c.scratch.receivers) receivers.clear();
  for (auto& places : c.scratch.places) places.clear();
  forEachFirstHit(c, 0, [&](const FirstHit& first) { split(c, first); });
  for (int layer = 0; layer < kLayers; ++layer)
    if (hasLayer(c.out.layerMask, layer)) gatherLayer(c, layer);
}

}  // namespace

void renderTask(const Transport& t, const View& view, const Task& task, const LightSet& lights,
                Scratch& scratch, TileResult& out) {
  const bool isReference = t.settings.method == Method::pathTrace;
  TaskContext context(t, view, task, lights, scratch, out, isReference ? kPathsPerPixel : 1);
  isReference ? pathTraceTask(context) : radiosityTask(context);
}

}  // namespace ninefold
