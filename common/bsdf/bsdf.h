// bsdf.h: how one surface point scatters: D, the Lambertian part, and the S lobes (all the rest).
//
//   D             f = diffuse / pi; its weight does not depend on directions
//   reflection    GGX with Smith's height-correlated masking (smooth when alpha = 0)
//                 opaque: Schlick's Fresnel f0 + (f90-f0)(1-cos)^5; under sheen and coat: layers.h
//                 dielectric: exact Fresnel of eta
//   transmission  GGX refraction (Walter 2007), smooth when alpha = 0
//                 thin-walled: straight on (rough: the mirror lobe, turned to the other side)
//                 plus the straight pass of weight `passThrough` (alpha blending), always smooth
//
// All is for basic radiance L/n^2, so weights hold no eta^2. Every lobe is symmetric in the measure
// n^2 dw, f(wo, wi; eta) = eta^2 f(wi, wo; 1/eta): particles and eye paths use the same functions.
// Directions are unit, local (z = shading normal) and point away from the surface. wo.z > 0 always:
// the caller turns the frame, and eta, to the side of wo. Fresnel's F and 1-F are part of the
// weights: the caller chooses the lobe by lobeAlbedo, or follows both.
// Refraction whose spread, alpha |eta - 1|, is below kSmoothAlpha is smooth; eta = 1 is invisible.
//
// Source:  Walter et al. 2007; Heitz 2018 (visible normals); Schlick 1994.
// Proved:  tests/bsdf (chi-square sample/pdf, reciprocity, albedo <= 1, smooth limits, extremes).
// Fails:   single-scattering GGX loses energy at high roughness: a white metal seen head-on keeps
//          92 % at alpha = 0.25, 69 % at 0.5, 31 % at 1. The tests state the loss.
// Threads: plain values, pure functions.   Errors: none; nullopt means "no light goes there".
#pragma once

#include <optional>

#include "common/math/units.h"

namespace ninefold {

enum class Lobe : uint8_t { reflection, transmission };

struct Bsdf {
  Reflectance diffuse{0};  // rho of D
  Vec3 f0{0};              // opaque: reflectance at normal incidence (Schlick); used if !dielectric
  Vec3 f90{1};             // opaque: reflectance at grazing incidence
  float alpha = 0;         // GGX roughness (already squared); below kSmoothAlpha it is set to 0
  float eta = 1;           // dielectric: index beyond the surface / index on wo's side
  bool reflects = false;   // reflection lobe present
  bool dielectric = false;   // exact Fresnel: reflects F, transmits (1-F) * transmissionTint
  bool thin = false;         // thin-walled dielectric: transmits straight on; F of both faces
  Vec3 reflectionTint{0};    // of the dielectric (KHR_materials_specular), usually 1
  Vec3 transmissionTint{0};  // base colour * transmission
  float passThrough = 0;     // 1 - opacity of alpha blending; the other parts are times opacity
  bool layered = false;      // opaque, under sheen or a clear coat
  float coat = 0, coatAlpha = 0;
  Vec3 sheen{0};
  float sheenAlpha = 1;  // >= kLeastSheenAlpha

  // Whether nothing but a delta reflects.
  bool isSmooth() const { return alpha == 0 && (!layered || (coatAlpha == 0 && isBlack(sheen))); }
  bool transmits() const { return passThrough > 0 || (dielectric && !isBlack(transmissionTint)); }
};

inline constexpr float kSmoothAlpha = 1e-3f;
inline constexpr float kLeastSheenAlpha = 0.04f;
inline constexpr float kCoatReflectance = 0.04f;  // at normal incidence: index 1.5

struct LobeSample {
  Vec3 wi;  // unit, local; wi.z < 0 when transmitted
  Vec3
      weight;  // f * |cos| / pdf, each in [0, 1] up to rounding; of layers below 8, and the mean is
  float pdf;   // per solid angle, given the lobe (uLobe's choice included); 0 if smooth (delta)
  bool smooth;
};

// Samples one lobe. uLobe chooses between refraction and the straight pass inside `transmission`,
// and among layers inside `reflection`.
std::optional<LobeSample> sampleLobe(const Bsdf& bsdf, Lobe lobe, Vec3 wo, Vec2 u, float uLobe);

// Share that passes straight on through a surface that bends nothing: through the holes of alpha
// blending and smooth thin walls.
Reflectance straightPass(const Bsdf& bsdf, float cosThetaO);

// f |cos wi| and sampleLobe's density, both [1/sr], of the part of a lobe that is not smooth.
struct LobeValue {
  Vec3 value{0};
  float pdf = 0;
};
LobeValue evaluateLobe(const Bsdf& bsdf, Lobe lobe, Vec3 wo, Vec3 wi);

// Directional albedo of a lobe, in [0, 1], for choosing among lobes and for albedo planes. Exact
// for smooth lobes; a table within 0.04 for opaque ones, layers within 0.1; four samples within 0.1
// for rough dielectrics.
Reflectance lobeAlbedo(const Bsdf& bsdf, Lobe lobe, float cosThetaO);

// Mean albedo of sheen of colour 1, likewise.
float meanSheen(float alpha);

// Mean albedo of the opaque GGX lobe over the cosine-weighted hemisphere: what a lobe too rough to
// be followed adds to rho when it is folded into D. 0 <= f0 <= 1.
Reflectance meanReflection(Vec3 f0, float alpha);

// Exact unpolarized Fresnel reflectance at |cosThetaI|, eta = n_t / n_i; 1 on total reflection.
float fresnelDielectric(float cosThetaI, float eta);

// Mean of fresnelDielectric over the cosine-weighted hemisphere.
float meanFresnelDielectric(float eta);

}  // namespace ninefold
