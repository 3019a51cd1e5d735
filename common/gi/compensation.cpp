#include "common/gi/compensation.h"

#include "common/gi/direct_light.h"
#include "common/gi/irradiance.h"

namespace ninefold {
namespace {

// A short ray from receiver i: where it goes and how far it matters.
struct ShortRay {
  Vec3 w{0};
  float cosX = 0;
  float reach = 0;  // sqrt(cos_x / b) [m]
};

ShortRay shortRay(const Transport& t, const Receivers& r, size_t i, Vec2 u) {
  ShortRay ray;
  ray.w = glm::normalize(Basis(r.ns(i)).toWorld(squareToCosineHemisphere(u)));
  ray.cosX = glm::dot(ray.w, r.ng(i));
  ray.reach = ray.cosX > 0 ? std::sqrt(ray.cosX / t.bound) : 0.0f;
  return ray;
}

// A hit that is followed: E(y) times `factor` goes to receiver `parent`.
struct Bounce {
  size_t parent;
  Vec3 factor;
};

// W of the hit; 0 where the geometry term is within its bound.
float excess(const Transport& t, const ShortRay& ray, const ShadingPoint& y, float distance) {
  const float cosY = -glm::dot(ray.w, y.ng);
  const float g = ray.cosX * cosY / (distance * distance);
  return g > t.bound ? 1 - t.bound / g : 0.0f;
}

Receiver receiverAt(const ShadingPoint& y, uint32_t pixel) {
  Receiver r;
  r.position = y.surface.position, r.ng = y.ng, r.ns = y.frame.normal;
  r.origin = offsetOrigin(y.surface, y.ng);
  r.pixel = pixel;
  return r;
}

}  // namespace

void compensate(const Transport& t, const LightSet& lights, const ReceiverSamples& samples,
                int pathVertices, Scratch& scratch, Receivers& receivers, RayCounts& rays) {
  const auto level = static_cast<size_t>(pathVertices) - 1;
  if (level == scratch.bounced.size()) scratch.bounced.emplace_back();
  Receivers& next = scratch.bounced[level];
  next.clear();
  std::vector<Bounce> bounces;
  const auto dimension = 4 * static_cast<uint32_t>(pathVertices - 1);
  for (size_t i = 0; i < receivers.size(); ++i) {
    const PixelSampler sampler = samples.of(receivers.pixel[i]);
    const ShortRay ray = shortRay(t, receivers, i, sampler.get2D(dimension));
    if (ray.reach <= 0) continue;
    ++rays.compensation;
    const Hit hit = t.tracer.closest(receivers.origin(i), ray.w, ray.reach);
    if (!hit || hit.t <= 0) continue;
    const ShadingPoint y = t.shader.shade(t.tracer.surface(hit), -ray.w, {});
    const float weight = excess(t, ray, y, hit.t);
    if (weight <= 0) continue;
    receivers.addIrradiance(i, kPi * weight * emittedRadiance(t, y));
    const Vec3 factor = weight * y.bsdf.diffuse;
    const float q = std::min(maxComponent(factor), kMaxSurvival);
    if (!t.allows(pathVertices + 1) || sampler.get1D(dimension + 2) >= q) continue;
    next.add(receiverAt(y, receivers.pixel[i]));
    bounces.push_back({i, factor / q});
  }
  if (bounces.empty()) return;
  gatherIrradiance(t, lights, samples, pathVertices + 1, scratch, next, nullptr, rays);
  for (size_t j = 0; j < bounces.size(); ++j)
    receivers.addIrradiance(bounces[j].parent, bounces[j].factor * next.irradiance(j));
}

}  // namespace ninefold
