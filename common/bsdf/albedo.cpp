// albedo.cpp: how much a lobe scatters in all.
//
// For the opaque lobe the Fresnel term is linear in f0, so one small table of two numbers,
// integrated once, serves every f0:
//   A(cos_o, alpha) = int D G2/(4 cos_o) dwi, the lobe with F = 1
//   B(cos_o, alpha) = the same with F = (1 - wo.m)^5
//   albedo = f0 (A - B) + B
// Rough dielectrics depend on eta as well: a mean over a few fixed samples, made when asked for.
#include "common/bsdf/ggx.h"
#include "common/bsdf/layers.h"
#include "common/bsdf/lobes.h"
#include "common/bsdf/squares_table.h"

namespace ninefold {

namespace {

struct Albedo {
  float a = 0, b = 0;
  Albedo operator+(Albedo o) const { return {a + o.a, b + o.b}; }
  Albedo operator-(Albedo o) const { return {a - o.a, b - o.b}; }
  friend Albedo operator*(float s, Albedo o) { return {s * o.a, s * o.b}; }
};

constexpr int kAngles = 32, kRoughs = 16;  // nodes of the table, in cos_o and alpha

constexpr float kLeastCosine = 1e-4f;

Vec3 upward(float cosTheta) {
  return Vec3(std::sqrt((1.0f - cosTheta) * (1.0f + cosTheta)), 0.0f, cosTheta);
}

Vec2 gridPoint(int k, int side) {
  return (Vec2(k % side, k / side) + Vec2(0.5f)) / static_cast<float>(side);
}

Reflectance opaqueAlbedo(Vec3 f0, Vec3 f90, Albedo all) {
  return f0 * (all.a - all.b) + f90 * all.b;
}

float power5(float x) { return x * x * x * x * x; }

// Visible-normal sampling makes the integrand smooth, so a regular grid of samples serves.
Albedo integrate(float cosThetaO, float alpha) {
  if (alpha == 0) return {1.0f, power5(1.0f - cosThetaO)};
  constexpr int kGrid = 16;
  const Vec3 wo = upward(cosThetaO);
  double a = 0, b = 0;
  for (int k = 0; k < kGrid * kGrid; ++k) {
    const Vec3 m = ggx::sampleVisibleNormal(wo, alpha, gridPoint(k, kGrid));
    const std::optional<Vec3> wi = reflectAbout(wo, m);
    if (!wi) continue;
    const MirrorLobe lobe = mirrorLobe(wo, *wi, m, alpha);
    a += lobe.masking;
    b += lobe.masking * power5(1.0f - std::clamp(lobe.cosine, 0.0f, 1.0f));
  }
  constexpr double kAll = kGrid * kGrid;
  return {static_cast<float>(a / kAll), static_cast<float>(b / kAll)};
}

Albedo mirrorAlbedo(float cosThetaO, float alpha) {
  if (alpha < kSmoothAlpha) return integrate(cosThetaO, 0);
  static const SquaresTable<kAngles, kRoughs, Albedo> table(
      [](float c, float roughness) { return integrate(std::max(c, kLeastCosine), roughness); });
  return table(cosThetaO, alpha);
}

// Mean weight over a few fixed samples; the straight pass is added by itself.
Reflectance meanWeight(const Bsdf& bsdf, Lobe lobe, float cosThetaO) {
  constexpr int kGrid = 2;
  Bsdf interface = bsdf;
  interface.passThrough = 0;
  Vec3 sum(0.0f);
  for (int k = 0; k < kGrid * kGrid; ++k) {
    const auto s = sampleLobe(interface, lobe, upward(cosThetaO), gridPoint(k, kGrid), 0);
    if (s) sum += s->weight / float(kGrid * kGrid);
  }
  return sum;
}

}  // namespace

Reflectance ggxAlbedo(const Bsdf& bsdf, float cosThetaO) {
  return opaqueAlbedo(bsdf.f0, bsdf.f90, mirrorAlbedo(cosThetaO, bsdf.alpha));
}

Reflectance lobeAlbedo(const Bsdf& bsdf, Lobe lobe, float cosThetaO) {
  const float c = std::clamp(cosThetaO, kLeastCosine, 1.0f);
  Reflectance albedo(0.0f);
  if (lobe == Lobe::transmission) {
    albedo = Vec3(bsdf.passThrough);
    if (bsdf.dielectric) {
      albedo +=
          smoothTransmission(bsdf) ? interfaceTransmittance(bsdf, c) : meanWeight(bsdf, lobe, c);
    }
  } else if (bsdf.reflects && bsdf.dielectric) {
    albedo = smoothReflection(bsdf) ? interfaceReflectance(bsdf, c) : meanWeight(bsdf, lobe, c);
  } else if (bsdf.reflects) {
    albedo = bsdf.layered ? layersAlbedo(bsdf, c) : ggxAlbedo(bsdf, c);
  }
  return glm::clamp(albedo, 0.0f, 1.0f);
}

// 2 int_0^1 albedo(c) c dc, with c = t^2 as in the table.
Reflectance meanReflection(Vec3 f0, float alpha) {
  constexpr int kSteps = 64;
  Vec3 sum(0.0f);
  for (int i = 0; i < kSteps; ++i) {
    const float t = (static_cast<float>(i) + 0.5f) / kSteps, c = t * t;
    const Albedo all = mirrorAlbedo(c, alpha);
    sum += 4.0f * t * c / kSteps * opaqueAlbedo(f0, Vec3(1.0f), all);
  }
  return glm::clamp(sum, 0.0f, 1.0f);
}

}  // namespace ninefold
