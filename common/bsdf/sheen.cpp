#include "common/bsdf/sheen.h"

#include "common/bsdf/bsdf.h"
#include "common/bsdf/squares_table.h"

namespace ninefold {
namespace sheen {
namespace {

constexpr int kAngles = 32, kRoughs = 16;  // cos_o = (i/31)^2; see alphaAt
constexpr float kLeastCosine = 1e-4f;

// ln Lambda, fitted between the curves of the roughest and the smoothest fibres.
float logLambda(float x, float alpha) {
  constexpr float kRough[] = {21.5473f, 3.82987f, 0.19823f, -1.97760f, -4.32054f};
  constexpr float kSmooth[] = {25.3245f, 3.32435f, 0.16801f, -1.27393f, -4.85967f};
  const float t = (1 - alpha) * (1 - alpha);
  float c[5];
  for (int i = 0; i < 5; ++i) c[i] = kRough[i] + t * (kSmooth[i] - kRough[i]);
  return c[0] / (1 + c[1] * std::pow(x, c[2])) + c[3] * x + c[4];
}

float lambda(float cosine, float alpha) {
  if (cosine < 0.5f) return std::exp(logLambda(cosine, alpha));
  return std::exp(2 * logLambda(0.5f, alpha) - logLambda(1 - std::min(cosine, 1.0f), alpha));
}

// Shares (i/15)^2 of the way from the least to 1.
float alphaAt(float share) { return kLeastSheenAlpha + (1 - kLeastSheenAlpha) * share; }
float shareOf(float alpha) { return (alpha - kLeastSheenAlpha) / (1 - kLeastSheenAlpha); }

float integrate(float cosThetaO, float alpha) {
  constexpr int kGrid = 24;
  const Vec3 wo(std::sqrt(1 - cosThetaO * cosThetaO), 0, cosThetaO);
  double sum = 0;
  for (int i = 0; i < kGrid; ++i)
    for (int j = 0; j < kGrid; ++j) {
      const float z = (static_cast<float>(i) + 0.5f) / kGrid, r = std::sqrt(1 - z * z);
      const float phi =
          kPi * (static_cast<float>(j) + 0.5f) / kGrid;  // the rest is its mirror image
      sum += double(value(wo, Vec3(r * std::cos(phi), r * std::sin(phi), z), alpha) / kPdf);
    }
  return static_cast<float>(sum / (kGrid * kGrid));
}

}  // namespace

float value(Vec3 wo, Vec3 wi, float alpha) {
  const Vec3 h = wo + wi;
  const float across = std::min((h.x * h.x + h.y * h.y) / glm::dot(h, h), 1.0f);  // sin_h^2
  const float d = (2 + 1 / alpha) * std::pow(across, 0.5f / alpha) * kPdf;
  const float v = 1 / (4 * wo.z * wi.z * (1 + lambda(wo.z, alpha) + lambda(wi.z, alpha)));
  return d * std::min(v, 1.0f) * wi.z;
}

float albedo(float cosThetaO, float alpha) {
  static const SquaresTable<kAngles, kRoughs> table(
      [](float c, float share) { return integrate(std::max(c, kLeastCosine), alphaAt(share)); });
  return std::clamp(table(cosThetaO, shareOf(alpha)), 0.0f, 1.0f);
}

namespace {

// 2 int_0^1 E(c) c dc, with c = t^2 as in the table.
float meanAt(float alpha) {
  constexpr int kSteps = 64;
  float sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const float t = (static_cast<float>(i) + 0.5f) / kSteps, c = t * t;
    sum += 4 * t * c / kSteps * albedo(c, alpha);
  }
  return std::min(sum, 1.0f);
}

}  // namespace
}  // namespace sheen

float meanSheen(float alpha) {
  static const SquaresTable<2, sheen::kRoughs> table(
      [](float, float share) { return sheen::meanAt(sheen::alphaAt(share)); });
  return table(0, sheen::shareOf(alpha));
}

}  // namespace ninefold
