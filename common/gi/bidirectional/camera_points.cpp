#include "common/gi/bidirectional/camera_points.h"

#include <optional>

#include "common/gi/eye/eye_path.h"
#include "common/gi/light/light_path.h"

namespace ninefold {
namespace {

struct End {
  ShadingPoint x;
  int absorber;
  Vec3 share;
};

// Where the path through `film` ends that follows the lobe that u chooses.
std::optional<End> follow(const Transport& t, const View& view, Vec2 film, float u,
                          const PixelSampler& sampler, RayCounts& rays) {
  const CameraRays camera(view.camera, view.width, view.height);
  film *= Vec2(view.width, view.height);
  const Vec3 direction = camera.direction(film.x, film.y);
  ++rays.eye;
  const Hit hit = t.tracer.closest(view.camera.eye + camera.start(film.x, film.y), direction,
                                   std::numeric_limits<float>::infinity());
  if (!hit) return std::nullopt;
  const ShadingPoint p = t.shader.shade(t.tracer.surface(hit), -direction, view.eyeMedia);
  const Vec3 through = t.shader.attenuation(p, view.eyeMedia, hit.t);
  const LobeChoice choice = albedoChoice(p.bsdf, p.localWo().z);
  const float sum = choice.sum();
  if (sum <= 0) return std::nullopt;
  u *= sum;
  if (u < choice.diffuse)
    return End{p, t.shader.absorber(p, view.eyeMedia),
               sum / choice.diffuse * through * p.bsdf.diffuse};
  const bool reflects = u < choice.diffuse + choice.reflection;
  const EyePathEnd end = followLobe(t, p, reflects ? Lobe::reflection : Lobe::transmission, hit.t,
                                    through, view.eyeMedia, sampler, 8, rays);
  if (!end.arrived) return std::nullopt;
  const float chance = (reflects ? choice.reflection : choice.transmission) / sum;
  return End{end.x, end.absorber, end.gain / chance * end.throughput * end.x.bsdf.diffuse};
}

}  // namespace

CameraPoints cameraPoints(const Transport& t, std::span<const View> views, const FrameKey& frame,
                          int k, int count, RayCounts& rays) {
  const int log2Count = log2Ceil(count);
  const Randomization points = t.settings.partition == PartitionRule::equal
                                   ? Randomization::random
                                   : t.settings.randomization;
  const LightSampler film(t.settings.seed, SampleUse::cameraPoint, frame.randomization,
                          static_cast<uint32_t>(k), log2Count, points);
  const PixelStream chains(t.settings.seed, SampleUse::cameraPoint, frame.randomization, 1, points);
  CameraPoints found;
  for (uint32_t i = 0; i < static_cast<uint32_t>(count); ++i) {
    const View& view = views[i * views.size() / static_cast<size_t>(count)];
    const auto end = follow(t, view, film.get2D(i, 0), film.get1D(i, 2),
                            PixelSampler(chains, i, static_cast<uint32_t>(k), 0), rays);
    if (!end) continue;
    found.points.add(receiverAt(end->x, i, end->absorber));
    found.shares.push_back(end->share);
  }
  found.points.pad();
  return found;
}

}  // namespace ninefold
