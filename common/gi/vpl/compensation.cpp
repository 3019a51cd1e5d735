#include "common/gi/vpl/compensation.h"

#include <bit>

#include "common/gi/eye/eye_path.h"
#include "common/gi/light/direct_light.h"
#include "common/gi/light/light_path.h"

namespace ninefold {
namespace {

// The short rays of sixteen receivers: where they go, and how far at this xi:
// sqrt((1-xi) cos_x / b) [m].
struct ShortRays {
  RayPacket packet;
  float cosX[kPacket];
  float xi[kPacket];
  uint32_t active = 0;

  Vec3 direction(size_t lane) const {
    return Vec3(packet.directionX[lane], packet.directionY[lane], packet.directionZ[lane]);
  }
};

// Of the receivers first ... first + 15, of which `count` are there and the rest is padding.
void aim(const Transport& t, const ReceiverSamples& samples, int level, const Receivers& r,
         size_t first, size_t count, ShortRays& rays) {
  Vec2 u[kPacket];
  for (size_t lane = 0; lane < kPacket; ++lane) {
    u[lane] = samples.compensationDirection(r.pixel[first + lane], level);
    rays.xi[lane] = samples.compensationRoulette(r.pixel[first + lane], level);
  }
#pragma GCC ivdep
  for (size_t lane = 0; lane < kPacket; ++lane) {
    const size_t i = first + lane;
    const Vec3 w = glm::normalize(Basis(r.ns(i)).toWorld(squareToCosineHemisphere(u[lane])));
    const float cosX = glm::dot(w, r.ng(i));
    rays.cosX[lane] = cosX;
    const float far2 = (1 - rays.xi[lane]) * std::max(cosX, 0.0f) / t.bound;
    rays.packet.set(lane, r.origin(i), w, 0, std::sqrt(far2));
  }
  for (size_t lane = 0; lane < count; ++lane)
    rays.active |= (rays.cosX[lane] > 0 ? 1u : 0u) << lane;
}

// W of the hit; 0 where the geometry term g is within its bound.
float excess(float g, float bound) { return g > bound ? 1 - bound / g : 0.0f; }

// What the hit emits, weighted by its own bound.
Radiance excessEmission(const Transport& t, const MinorLamps* leftOut, const Hit& hit,
                        const ShadingPoint& y, float g) {
  const int emitter = t.emitters.find(hit.instance, hit.triangle);
  if (emitter < 0) return Radiance(0);
  if (leftOut != nullptr && leftOut->has(lampOf(t.emitters[static_cast<size_t>(emitter)])))
    return Radiance(0);
  return excess(g, t.lightBound(static_cast<uint32_t>(emitter))) * emittedRadiance(t, y);
}

// One level of the recursion: the receivers, and what their short rays met that is to be followed.
struct Level {
  const Transport& t;
  const ReceiverSamples& samples;
  int pathVertices;
  CompensationParts parts;  // of what this level can bring
  bool seesLamps;
  Receivers& receivers;
  Bounces& next;
  RayCounts& rays;

  // E(y), for `factor` times it at receiver i. `absorber` of y.
  void follow(size_t i, const ShadingPoint& y, int absorber, Vec3 factor) {
    next.points.add(receiverAt(y, receivers.pixel[i], absorber));
    next.parents.push_back({i, factor});
  }

  // What the glossy lobe of y sends to receiver i, times `factor`.
  void followGlossy(size_t i, const ShadingPoint& y, Vec3 factor) {
    MediumStack media;
    if (const int absorber = receivers.absorber[i]; absorber >= 0) t.shader.enter(media, absorber);
    const EyePathEnd end =
        followLobe(t, y, Lobe::reflection, 0, Vec3(1), media,
                   samples.glossyPath(receivers.pixel[i], pathVertices), 0, rays);
    if (parts.emission) receivers.addIrradiance(i, kPi * factor * end.unfiltered);
    if (end.arrived && parts.onward)
      follow(i, end.x, end.absorber, end.gain * factor * end.throughput * end.x.bsdf.diffuse);
  }

  // The ray of receiver i met `hit`, and goes straight on where that lets it pass.
  void meetAll(size_t i, float cosX, Vec3 w, float xi, float far, Hit hit) {
    Vec3 passed(1);
    for (int met = 0; hit && hit.t > 0 && met <= t.settings.specularDepth; ++met) {
      const SurfacePoint s = t.tracer.surface(hit);
      meet(i, cosX, w, xi, hit, s, passed);
      if (!t.shader.passesStraight(s)) return;
      passed *= straightPass(t.shader.shade(s, -w, {}));
      if (isBlack(passed) || !(far > hit.t)) return;
      ++rays.compensation;
      const float before = hit.t;
      hit = t.tracer.closest(offsetOrigin(s, w), w, far - before);
      hit.t += before;
    }
  }

  // Receiver i met `hit` in direction w at xi.
  void meet(size_t i, float cosX, Vec3 w, float xi, const Hit& hit, const SurfacePoint& s,
            Vec3 passed) {
    const float g = cosX * std::abs(glm::dot(w, s.geometricNormal)) / (hit.t * hit.t);
    const float above = excess(g, t.bound);
    if (above <= 0) return;
    const Vec3 left = passed * t.shader.transmittance(receivers.absorber[i], hit.t);
    const ShadingPoint y = t.shader.shade(s, -w, {});
    // Probability of a ray that is long enough, at least `above`.
    const float reached = std::max(1 - t.bound * hit.t * hit.t / cosX, above);
    if (parts.emission && seesLamps)
      receivers.addIrradiance(i,
                              kPi / reached * left * excessEmission(t, parts.leftOut, hit, y, g));
    const Vec3 factor = above * left * y.bsdf.diffuse;
    float q = std::min(maxComponent(factor), kMaxSurvival), qGlossy = 0;
    if (parts.glossy && isGlossy(y.bsdf)) {
      qGlossy = maxComponent(left * lobeAlbedo(y.bsdf, Lobe::reflection, y.localWo().z)) * above;
      const float scale = std::min(std::min(above, kMaxSurvival) / (q + qGlossy), 1.0f);
      q *= scale, qGlossy *= scale;
    }
    // y is in the same medium as the receiver whose ray met it.
    if (xi < q && parts.onward) follow(i, y, receivers.absorber[i], factor / q);
    if (xi >= q && xi < q + qGlossy) followGlossy(i, y, above / qGlossy * left);
  }

  // The receivers first ... first + 15.
  void trace(size_t first) {
    ShortRays shorts;
    const size_t lanes = std::min<size_t>(kPacket, receivers.size() - first);
    aim(t, samples, pathVertices, receivers, first, lanes, shorts);
    rays.compensation += static_cast<uint64_t>(std::popcount(shorts.active));
    Hit hits[kPacket];
    float far[kPacket];
    std::copy_n(shorts.packet.farT, kPacket, far);
    t.tracer.closest16(shorts.packet, shorts.active, hits, false);
    for (size_t lane = 0; lane < lanes; ++lane)
      if ((shorts.active >> lane & 1u) != 0)
        meetAll(first + lane, shorts.cosX[lane], shorts.direction(lane), shorts.xi[lane], far[lane],
                hits[lane]);
  }
};

}  // namespace

void compensate(const Transport& t, const ReceiverSamples& samples, int pathVertices,
                CompensationParts parts, CompensationScratch& scratch, Receivers& receivers,
                RayCounts& rays, const IrradianceQuery& irradiance) {
  const auto depth = static_cast<size_t>(pathVertices) - 1;
  while (scratch.size() <= depth) scratch.emplace_back();
  Bounces& next = scratch[depth];
  next.clear();
  parts.onward = parts.onward && t.allows(pathVertices + 1);
  Level level{
      t,         samples, pathVertices, parts, pathVertices > 1 || t.settings.directVpls > 0,
      receivers, next,    rays};
  for (size_t first = 0; first < receivers.size(); first += kPacket) level.trace(first);
  if (next.parents.empty()) return;
  irradiance(pathVertices + 1, next.points);
  for (size_t j = 0; j < next.parents.size(); ++j)
    receivers.addIrradiance(next.parents[j].receiver,
                            next.parents[j].factor * next.points.irradiance(j));
}

}  // namespace ninefold
