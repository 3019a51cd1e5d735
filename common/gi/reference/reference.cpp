#include "common/gi/reference/reference.h"

#include "common/gi/eye/first_hits.h"
#include "common/gi/light/direct_light.h"
#include "common/gi/reference/path_tracer.h"

namespace ninefold {
namespace {

constexpr float kShare = 1.0f / kPathsPerPixel;

void add(RgbPlane& plane, size_t i, Vec3 v) {
  plane.r[i] += v.x, plane.g[i] += v.y, plane.b[i] += v.z;
}

void addIncident(TaskContext& c, const FirstHit& first, const PixelSampler& sampler) {
  ShadingPoint white = first.point;
  white.bsdf = {};
  white.bsdf.diffuse = Vec3(1);
  const PathLight light = scatteredLight(c.t, white, c.view.eyeMedia, sampler, c.out.rays);
  if (c.wants(kIrradiancePlane))
    add(c.out.extras.irradiance, first.pixel, kShare * kPi * light.all);
  if (c.wants(kCausticPlane)) add(c.out.extras.caustic, first.pixel, kShare * kPi * light.caustic);
}

void addPath(TaskContext& c, const FirstHit& first, const PixelSampler& sampler) {
  LayerPlanes& out = c.out.layers[kDiffuse];
  if (!first)
    return add(out.unfiltered, first.pixel, kShare * c.t.emitters.environment(first.direction));
  const ShadingPoint& p = first.point;
  const Vec3 through = kShare * c.t.shader.attenuation(p, c.view.eyeMedia, first.distance);
  const PathLight light = scatteredLight(c.t, p, c.view.eyeMedia, sampler, c.out.rays);
  add(out.unfiltered, first.pixel, through * (emittedRadiance(c.t, p) + light.all));
  if (isBlack(p.bsdf.diffuse)) return;
  if (c.wants(kIrradiancePlane) || c.wants(kCausticPlane)) addIncident(c, first, sampler);
  if (c.wants(kCausticPlane)) add(out.reflectance, first.pixel, kInvPi * through * p.bsdf.diffuse);
}

}  // namespace

std::shared_ptr<const FrameLight> Reference::light(const FrameKey&, int, std::span<const View>,
                                                   const MethodState*) const {
  return std::make_shared<const FrameLight>();
}

std::unique_ptr<Scratch> Reference::makeScratch() const { return std::make_unique<Scratch>(); }

void Reference::render(const View& view, const Task& task, const FrameLight&, Scratch&,
                       TileResult& out) const {
  TaskContext c(t_, view, task, out, kPathsPerPixel);
  for (uint32_t path = 0; path < kPathsPerPixel; ++path)
    forEachFirstHit(c, path, [&](const FirstHit& first) {
      addPath(c, first, c.sampler(first.x, first.y, path));
    });
}

}  // namespace ninefold
