// lobes.h: the parts behind bsdf.h. Each lobe has one function that samples and one that evaluates.
// Both get weight = f |cos wi| / pdf and pdf from the same expressions, so they cannot disagree.
// Internal to common/bsdf.
//
// Threads: pure functions.   Errors: none.
#pragma once

#include "common/bsdf/bsdf.h"

namespace ninefold {

// Shares that an interface sends back and lets through, at `cosine` to its (micro) normal. A thin
// wall adds up the bounces between its two faces: F' = 2F/(1+F), and lets 1 - F' through.
Vec3 interfaceReflectance(const Bsdf& bsdf, float cosine);
Vec3 interfaceTransmittance(const Bsdf& bsdf, float cosine);

// Rough refraction bends by about alpha |eta - 1|. Where that is less than the least roughness, the
// interface is smooth for light that passes; so index 1 is invisible.
inline bool smoothReflection(const Bsdf& bsdf) { return bsdf.alpha < kSmoothAlpha; }
inline bool smoothTransmission(const Bsdf& bsdf) {
  return bsdf.alpha * std::min(std::abs(bsdf.eta - 1.0f), 1.0f) < kSmoothAlpha;
}

// The parts of the transmission lobe are chosen in proportion to what they let through.
struct TransmissionSplit {
  float straight;   // weight of the straight pass
  float refracted;  // bound of the weight of refraction
  float chance() const { return straight / (straight + refracted); }
};
TransmissionSplit splitTransmission(const Bsdf& bsdf, float cosThetaO);

// Without layers over it.
std::optional<LobeSample> sampleReflection(const Bsdf& bsdf, Vec3 wo, Vec2 u);
LobeValue evaluateReflection(const Bsdf& bsdf, Vec3 wo, Vec3 wi);
std::optional<LobeSample> sampleTransmission(const Bsdf& bsdf, Vec3 wo, Vec2 u, float uLobe);
LobeValue evaluateTransmission(const Bsdf& bsdf, Vec3 wo, Vec3 wi);

// Albedo of the opaque GGX lobe, without layers over it.
Reflectance ggxAlbedo(const Bsdf& bsdf, float cosThetaO);

// GGX mirror lobe of reflection, and of rough thin walls turned to this side. wo.z > 0, wi.z > 0.
struct MirrorLobe {
  float cosine;   // wo . m
  float masking;  // G2(wo, wi) / G1(wo)
  float pdf;      // of wi [1/sr]
};
MirrorLobe mirrorLobe(Vec3 wo, Vec3 wi, Vec3 m, float alpha);
std::optional<Vec3> halfway(Vec3 wo, Vec3 wi);      // unit; nullopt if they cancel out
std::optional<Vec3> reflectAbout(Vec3 wo, Vec3 m);  // unit; nullopt if it ends below the surface

}  // namespace ninefold
