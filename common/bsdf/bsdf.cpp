// bsdf.cpp: which lobe, and what its interface reflects and transmits.
#include "common/bsdf/bsdf.h"

#include "common/bsdf/layers.h"
#include "common/bsdf/lobes.h"

namespace ninefold {

namespace {

// Schlick 1994.
Vec3 schlick(Vec3 f0, Vec3 f90, float cosine) {
  const float s = std::clamp(1.0f - cosine, 0.0f, 1.0f);
  const float s2 = s * s;
  return f0 + (f90 - f0) * (s2 * s2 * s);
}

float dielectricReflectance(const Bsdf& bsdf, float cosine) {
  const float f = fresnelDielectric(cosine, bsdf.eta);
  return bsdf.thin ? 2.0f * f / (1.0f + f) : f;
}

}  // namespace

Vec3 interfaceReflectance(const Bsdf& bsdf, float cosine) {
  if (!bsdf.dielectric) return schlick(bsdf.f0, bsdf.f90, cosine);
  return dielectricReflectance(bsdf, cosine) * bsdf.reflectionTint;
}

Vec3 interfaceTransmittance(const Bsdf& bsdf, float cosine) {
  return (1.0f - dielectricReflectance(bsdf, cosine)) * bsdf.transmissionTint;
}

std::optional<LobeSample> sampleLobe(const Bsdf& bsdf, Lobe lobe, Vec3 wo, Vec2 u, float uLobe) {
  if (lobe == Lobe::transmission) return sampleTransmission(bsdf, wo, u, uLobe);
  if (!bsdf.reflects) return std::nullopt;
  return bsdf.layered ? sampleLayers(bsdf, wo, u, uLobe) : sampleReflection(bsdf, wo, u);
}

LobeValue evaluateLobe(const Bsdf& bsdf, Lobe lobe, Vec3 wo, Vec3 wi) {
  if (lobe == Lobe::transmission) return evaluateTransmission(bsdf, wo, wi);
  if (!bsdf.reflects) return {};
  return bsdf.layered ? evaluateLayers(bsdf, wo, wi) : evaluateReflection(bsdf, wo, wi);
}

}  // namespace ninefold
