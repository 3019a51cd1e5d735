#include "common/gi/tile_renderer.h"

#include "common/gi/direct_light.h"
#include "common/gi/eye_path.h"
#include "common/gi/irradiance.h"
#include "common/gi/path_tracer.h"

namespace ninefold {
namespace {

constexpr int kBlock = 4;  // a packet is a 4 x 4 block of the sub-plane

void put(RgbPlane& plane, size_t i, Vec3 v) {
  plane.r[i] = v.x, plane.g[i] = v.y, plane.b[i] = v.z;
}

// One task's constants, so that the functions below stay short.
struct TaskContext {
  const Transport& t;
  const View& view;
  const Task& task;
  const LightSet& lights;
  TaskRect rect;
  TileGrid grid;
  CameraRays camera;
  Scratch& scratch;
  TileResult& out;
  PixelStream eyePaths;

  PixelSampler sampler(int x, int y, uint32_t path) const {
    return PixelSampler(eyePaths, static_cast<uint32_t>(x), static_cast<uint32_t>(y), path);
  }
  int pixelX(int i) const { return grid.pixelX(task.phase, rect.i0 + i); }
  int pixelY(int j) const { return grid.pixelY(task.phase, rect.j0 + j); }
};

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

void fillExtras(TaskContext& c, const ShadingPoint& p, size_t pixel, float depth) {
  ExtraPlanes& e = c.out.extras;
  const uint8_t mask = c.task.extraMask;
  if ((mask & kAlbedoPlane) != 0) {
    Vec3 albedo = p.bsdf.diffuse;
    const float cosine = p.localWo().z;
    if (p.bsdf.reflects) albedo += lobeAlbedo(p.bsdf, Lobe::reflection, cosine);
    if (p.bsdf.transmits()) albedo += lobeAlbedo(p.bsdf, Lobe::transmission, cosine);
    put(e.albedo, pixel, glm::min(albedo, Vec3(1)));
  }
  if ((mask & kNormalPlane) != 0) put(e.normal, pixel, p.ns);
  if ((mask & kDepthPlane) != 0) e.depth[pixel] = depth;
  if ((mask & kObjectPlane) != 0) e.object[pixel] = p.surface.instance + 1;
}

void followLayer(TaskContext& c, const ShadingPoint& first, Lobe lobe, float distance,
                 Reflectance through, size_t pixel, const PixelSampler& sampler) {
  const int layer = lobe == Lobe::reflection ? kReflection : kTransmission;
  const uint32_t dimension = 8 + static_cast<uint32_t>(layer - 1) * eyePathDimensions(c.t.settings);
  const EyePathEnd end = followLobe(c.t, first, lobe, distance, through, c.view.eyeMedia, sampler,
                                    dimension, c.out.rays);
  put(c.out.layers[static_cast<size_t>(layer)].unfiltered, pixel, end.unfiltered);
  if (end.arrived)
    addReceiver(c, layer, end.x, pixel, end.absorber, end.throughput, end.gain, end.distance,
                end.chain);
}

void shadeFirstHit(TaskContext& c, const Hit& hit, Vec3 direction, int i, int j) {
  const auto pixel = static_cast<size_t>(j * c.rect.width + i);
  LayerPlanes& diffuse = c.out.layers[kDiffuse];
  if (!hit) {
    put(diffuse.unfiltered, pixel, c.t.emitters.environment());
    return;
  }
  const ShadingPoint p = c.t.shader.shade(c.t.tracer.surface(hit), -direction, c.view.eyeMedia);
  const Vec3 through = c.t.shader.attenuation(p, c.view.eyeMedia, hit.t);
  if (c.task.extraMask != 0)
    fillExtras(c, p, pixel, hit.t * glm::dot(direction, c.view.camera.forward));
  put(diffuse.unfiltered, pixel, through * emittedRadiance(c.t, p));
  if (!isBlack(p.bsdf.diffuse))
    addReceiver(c, kDiffuse, p, pixel, c.t.shader.absorber(p, c.view.eyeMedia), through, 1, hit.t,
                0);
  if (!p.bsdf.reflects && !p.bsdf.transmits()) return;
  const PixelSampler sampler = c.sampler(c.pixelX(i), c.pixelY(j), 0);
  if (p.bsdf.reflects) followLayer(c, p, Lobe::reflection, hit.t, through, pixel, sampler);
  if (p.bsdf.transmits()) followLayer(c, p, Lobe::transmission, hit.t, through, pixel, sampler);
}

void traceBlock(TaskContext& c, int bi, int bj) {
  RayPacket rays;
  Hit hits[kPacket];
  uint32_t active = 0;
  for (int lane = 0; lane < kPacket; ++lane) {
    const int i = std::min(bi + lane % kBlock, c.rect.width - 1);
    const int j = std::min(bj + lane / kBlock, c.rect.height - 1);
    const int x = c.pixelX(i), y = c.pixelY(j);
    const Vec2 offset = c.t.settings.jitter ? c.sampler(x, y, 0).get2D(0) : Vec2(0.5f);
    const Vec3 direction =
        c.camera.direction(static_cast<float>(x) + offset.x, static_cast<float>(y) + offset.y);
    rays.set(lane, c.view.camera.eye, direction, 0, std::numeric_limits<float>::infinity());
    const bool inside = bi + lane % kBlock < c.rect.width && bj + lane / kBlock < c.rect.height;
    active |= (inside ? 1u : 0u) << lane;
  }
  c.t.tracer.closest16(rays, active, hits);
  for (int lane = 0; lane < kPacket; ++lane) {
    if ((active >> lane & 1u) == 0) continue;
    ++c.out.rays.eye;
    const int i = bi + lane % kBlock, j = bj + lane / kBlock;
    const Vec3 direction(rays.directionX[lane], rays.directionY[lane], rays.directionZ[lane]);
    shadeFirstHit(c, hits[lane], direction, i, j);
  }
}

void gatherLayer(TaskContext& c, int layer) {
  Receivers& receivers = c.scratch.receivers[static_cast<size_t>(layer)];
  const std::vector<uint32_t>& places = c.scratch.places[static_cast<size_t>(layer)];
  LayerPlanes& planes = c.out.layers[static_cast<size_t>(layer)];
  const Settings& s = c.t.settings;
  const ReceiverSamples samples(s.seed, c.task.frame.randomization, static_cast<uint32_t>(layer));
  const bool wantsCaustic = layer == kDiffuse && (c.task.extraMask & kCausticPlane) != 0;
  std::vector<Irradiance> caustic(wantsCaustic ? receivers.size() : 0, Irradiance(0));
  gatherIrradiance(c.t, c.lights, samples, 1, c.scratch, receivers,
                   wantsCaustic ? &caustic : nullptr, c.out.rays);
  for (size_t i = 0; i < receivers.size(); ++i) {
    put(planes.irradiance, places[i], receivers.gain[i] * receivers.irradiance(i));
    if (wantsCaustic) put(c.out.extras.caustic, places[i], caustic[i]);
  }
}

// The reference method: whole radiance as U of the diffuse layer, which no filter touches.
void pathTracePixel(TaskContext& c, int i, int j) {
  const Settings& s = c.t.settings;
  const int x = c.pixelX(i), y = c.pixelY(j);
  Radiance sum(0);
  for (uint32_t path = 0; path < kPathsPerPixel; ++path) {
    const PixelSampler sampler = c.sampler(x, y, path);
    const Vec2 offset = s.jitter ? sampler.get2D(0) : Vec2(0.5f);
    const Vec3 direction =
        c.camera.direction(static_cast<float>(x) + offset.x, static_cast<float>(y) + offset.y);
    sum += tracePath(c.t, c.view.camera.eye, direction, c.view.eyeMedia, sampler, c.out.rays);
  }
  put(c.out.layers[kDiffuse].unfiltered, static_cast<size_t>(j * c.rect.width + i),
      sum / static_cast<float>(kPathsPerPixel));
}

// Instant radiosity: eye paths to their layers' receivers, then the set's light for all of them.
void radiosityTask(TaskContext& c) {
  for (Receivers& receivers : c.scratch.receivers) receivers.clear();
  for (auto& places : c.scratch.places) places.clear();
  for (int bj = 0; bj < c.rect.height; bj += kBlock)
    for (int bi = 0; bi < c.rect.width; bi += kBlock) traceBlock(c, bi, bj);
  for (int layer = 0; layer < kLayers; ++layer)
    if (hasLayer(c.out.layerMask, layer)) gatherLayer(c, layer);
}

}  // namespace

void renderTask(const Transport& t, const View& view, const Task& task, const LightSet& lights,
                Scratch& scratch, TileResult& out) {
  const Settings& s = t.settings;
  const TileGrid grid(view.width, view.height, s.interleave);
  const TaskRect rect = task.rect.value_or(grid.rect(task.tile, task.phase));
  out.reset(rect.width, rect.height, layerMaskOf(t.needs, s.method), task.extraMask);
  TaskContext c{t,
                view,
                task,
                lights,
                rect,
                grid,
                CameraRays(view.camera, view.width, view.height),
                scratch,
                out,
                PixelStream(s.seed, SampleUse::eyePath, task.frame.randomization,
                            s.method == Method::pathTrace ? kPathsPerPixel : 1, s.randomization)};
  if (s.method == Method::instantRadiosity) return radiosityTask(c);
  for (int j = 0; j < rect.height; ++j)
    for (int i = 0; i < rect.width; ++i) pathTracePixel(c, i, j);
}

}  // namespace ninefold
