// materials.h: the surfaces that the tests of common/bsdf look at, and directions towards them.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "common/bsdf/bsdf.h"
#include "common/sampling/sampler.h"

namespace ninefold {

inline Bsdf metal(float alpha, Vec3 f0 = Vec3(0.9f, 0.6f, 0.3f)) {
  Bsdf b;
  b.reflects = true;
  b.f0 = f0;
  b.alpha = alpha;
  return b;
}

inline Bsdf glass(float alpha, float eta, bool thin = false) {
  Bsdf b;
  b.reflects = true;
  b.dielectric = true;
  b.alpha = alpha;
  b.eta = eta;
  b.thin = thin;
  b.reflectionTint = Vec3(1.0f);
  b.transmissionTint = Vec3(1.0f);
  return b;
}

// Varnish over a surface. weight 1 as a rule.
inline Bsdf coated(Bsdf base, float coatAlpha, float weight = 1) {
  base.layered = base.reflects = true;
  base.coat = weight, base.coatAlpha = coatAlpha;
  return base;
}

// Cloth that reflects by its sheen alone, or a surface under sheen.
inline Bsdf cloth(float sheenAlpha, Vec3 colour = Vec3(0.9f, 0.5f, 0.2f)) {
  Bsdf b;
  b.layered = b.reflects = true;
  b.f0 = b.f90 = Vec3(0);
  b.sheen = colour, b.sheenAlpha = sheenAlpha;
  return b;
}
inline Bsdf underSheen(Bsdf base, float sheenAlpha) {
  base.layered = base.reflects = true;
  base.sheen = Vec3(0.4f, 0.8f, 0.6f), base.sheenAlpha = sheenAlpha;
  return base;
}

// Unit direction on the upper side, in the plane y = 0.
inline Vec3 upward(float cosTheta) {
  return Vec3(std::sqrt(std::max(0.0f, 1.0f - cosTheta * cosTheta)), 0.0f, cosTheta);
}

// Independent random numbers; `stream` keeps the tests apart.
inline float random1(uint64_t i, uint64_t stream) {
  return unitFloat(static_cast<uint32_t>(hashWords(i, stream, 1)));
}
inline Vec2 random2(uint64_t i, uint64_t stream) {
  const uint64_t h = hashWords(i, stream);
  return Vec2(unitFloat(static_cast<uint32_t>(h)), unitFloat(static_cast<uint32_t>(h >> 32)));
}

// Mean weight of a lobe over n x n stratified samples: its directional albedo.
inline Vec3 sampledAlbedo(const Bsdf& bsdf, Lobe lobe, Vec3 wo, int n = 64) {
  DVec3 sum(0);
  for (int k = 0; k < n * n; ++k) {
    const Vec2 u = (Vec2(k % n, k / n) + random2(static_cast<uint64_t>(k), 77)) / float(n);
    const auto s = sampleLobe(bsdf, lobe, wo, u, random1(static_cast<uint64_t>(k), 78));
    if (s) sum += DVec3(s->weight);
  }
  return Vec3(sum / double(n * n));
}

}  // namespace ninefold
