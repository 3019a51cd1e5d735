// fresnel.cpp: how much a smooth dielectric interface reflects.
// Source: Born and Wolf, Principles of Optics, 1.5.
#include "common/bsdf/bsdf.h"

namespace ninefold {

namespace {

// Beyond it the interface reflects all but 4e-6, and eta^2 nears overflow.
constexpr float kMirrorEta = 1e6f;

}  // namespace

// With g = eta cos_t = sqrt(eta^2 - 1 + cos_i^2):
// F = (r_s^2 + r_p^2)/2, r_s = (cos_i - g)/(cos_i + g), r_p = (eta^2 cos_i - g)/(eta^2 cos_i + g).
float fresnelDielectric(float cosThetaI, float eta) {
  if (eta == 1.0f) return 0.0f;
  if (!(eta < kMirrorEta)) return 1.0f;
  const float c = std::min(std::abs(cosThetaI), 1.0f);
  const float g2 = (eta - 1.0f) * (eta + 1.0f) + c * c;
  if (g2 <= 0.0f) return 1.0f;
  const float g = std::sqrt(g2);
  const float rs = (c - g) / (c + g);
  const float rp = (eta * eta * c - g) / (eta * eta * c + g);
  return std::min(0.5f * (rs * rs + rp * rp), 1.0f);
}

// F_mean = 2 int_0^1 F(c) c dc. With c = t^4 the steep rise towards grazing, where the scale is
// sqrt(eta^2 - 1), is smooth in t. From the dense side, light below the critical angle goes both
// ways alike: (1 - F_mean(eta)) = eta^2 (1 - F_mean(1/eta)).
float meanFresnelDielectric(float eta) {
  if (eta < 1.0f) return 1.0f - eta * eta * (1.0f - meanFresnelDielectric(1.0f / eta));
  constexpr int kSteps = 128;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double t = (i + 0.5) / kSteps, c = t * t * t * t;
    sum += 2 * c * 4 * t * t * t / kSteps * fresnelDielectric(static_cast<float>(c), eta);
  }
  return std::clamp(static_cast<float>(sum), 0.0f, 1.0f);
}

}  // namespace ninefold
