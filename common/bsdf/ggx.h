// ggx.h: the isotropic GGX distribution of microfacet normals m, seen through Smith masking.
//
//   D(m)   = alpha^2 / (pi (sin_m^2 + alpha^2 cos_m^2)^2)                       [1/sr]
//   s(w)   = sqrt(cos_w^2 + alpha^2 sin_w^2)
//   G1(w)  = 2 cos_w / (cos_w + s(w))
//   G2     = 2 cos_o cos_i / (s_o cos_i + s_i cos_o)      height-correlated, both on one side
//   p(m)   = G1(wo) max(wo.m, 0) D(m) / cos_o             visible normals      [1/sr]
//
// No expression divides by a cosine, so grazing directions stay finite. Internal to common/bsdf.
//
// Source:  Walter et al. 2007; Heitz 2014 (masking), 2018 (visible normals); Dupuy and Benyoub 2023
//          (sampling by spherical caps).
// Proved:  tests/bsdf (chi-square through each lobe).
// Threads: pure functions.
#pragma once

#include "common/math/units.h"

namespace ninefold::ggx {

inline float distribution(Vec3 m, float alpha) {
  const float t = m.x * m.x + m.y * m.y + alpha * alpha * m.z * m.z;
  return alpha * alpha * kInvPi / (t * t);
}

inline float slope(Vec3 w, float alpha) {
  return std::sqrt(w.z * w.z + alpha * alpha * (w.x * w.x + w.y * w.y));
}

// G1(w)/cos_w; finite for all w while alpha > 0.
inline float maskingOverCos(Vec3 w, float alpha) {
  return 2.0f / (std::abs(w.z) + slope(w, alpha));
}

inline float masking(Vec3 w, float alpha) { return std::abs(w.z) * maskingOverCos(w, alpha); }

inline float visibleNormalPdf(Vec3 wo, Vec3 m, float alpha) {
  return maskingOverCos(wo, alpha) * std::max(glm::dot(wo, m), 0.0f) * distribution(m, alpha);
}

// A normal with density p(m). The surface is stretched to a hemisphere, whose visible normals are
// the halfway vectors between the view and a uniform spherical cap z > -wo.z.
inline Vec3 sampleVisibleNormal(Vec3 wo, float alpha, Vec2 u) {
  const Vec3 w = glm::normalize(Vec3(alpha * wo.x, alpha * wo.y, wo.z));
  const float below = u.y * (1.0f + w.z);           // 1 - z of the cap's point
  const float above = (1.0f - u.y) * (1.0f + w.z);  // z + w.z
  const float sine = std::sqrt(below * std::max(above + (1.0f - w.z), 0.0f));
  const float phi = 2.0f * kPi * u.x;
  const Vec3 h(sine * std::cos(phi) + w.x, sine * std::sin(phi) + w.y, above);
  return glm::normalize(Vec3(alpha * h.x, alpha * h.y, h.z));
}

}  // namespace ninefold::ggx
