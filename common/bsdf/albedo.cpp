// albedo.cpp: how much a lobe scatters in all.
//
// For the opaque lobe the Fresnel term is linear in f0, so one small table of two numbers,
// integrated once, serves every f0:
//   A(cos_o, alpha) = int D G2/(4 cos_o) dwi, the lobe with F = 1
//   B(cos_o, alpha) = the same with F = (1 - wo.m)^5
//   albedo = f0 (A - B) + B
// Rough dielectrics depend on eta as well: a mean over a few fixed samples, made when asked for.
#include <array>

#include "common/bsdf/ggx.h"
#include "common/bsdf/lobes.h"

namespace ninefold {

namespace {

struct Albedo {
  float a, b;
};

constexpr int kAngles = 32;  // cos_o = (i/31)^2: denser where grazing light rises steeply
constexpr int kRoughs = 16;  // alpha = (j/15)^2
using Table = std::array<std::array<Albedo, kAngles>, kRoughs>;

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

Table makeTable() {
  Table table;
  for (int j = 0; j < kRoughs; ++j) {
    const float r = static_cast<float>(j) / (kRoughs - 1);
    for (int i = 0; i < kAngles; ++i) {
      const float c = static_cast<float>(i) / (kAngles - 1);
      table[static_cast<size_t>(j)][static_cast<size_t>(i)] =
          integrate(std::max(c * c, kLeastCosine), r * r);
    }
  }
  return table;
}

struct Place {
  size_t index;  // of the lower neighbour
  float part;    // of the upper one
};

// `value` = (position/(nodes - 1))^2.
Place place(float value, int nodes) {
  const float x = std::sqrt(std::clamp(value, 0.0f, 1.0f)) * static_cast<float>(nodes - 1);
  const int index = std::min(static_cast<int>(x), nodes - 2);
  return {static_cast<size_t>(index), x - static_cast<float>(index)};
}

Albedo mix(Albedo x, Albedo y, float part) {
  return {x.a + part * (y.a - x.a), x.b + part * (y.b - x.b)};
}

Albedo mirrorAlbedo(float cosThetaO, float alpha) {
  if (alpha < kSmoothAlpha) return integrate(cosThetaO, 0);
  static const Table table = makeTable();
  const Place c = place(cosThetaO, kAngles), r = place(alpha, kRoughs);
  const auto& low = table[r.index];
  const auto& high = table[r.index + 1];
  return mix(mix(low[c.index], low[c.index + 1], c.part),
             mix(high[c.index], high[c.index + 1], c.part), r.part);
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
    albedo = opaqueAlbedo(bsdf.f0, bsdf.f90, mirrorAlbedo(c, bsdf.alpha));
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
