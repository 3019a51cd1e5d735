// transmission.cpp: light that passes: straight on, bent by a smooth interface, or spread by a
// rough one. Through thin walls: the mirror lobe, turned to the other side.
//
//   f |cos_i| = (1-F) G1(wo) G1(wi) D(m) (wo.m) / cos_o  dm/dwi              [1/sr]
//   dm/dwi    = eta^2 |wi.m| / (wo.m + eta wi.m)^2 = eta g (c + g)^2 / (eta^2 - 1)^2,
//               c = wo.m, g = eta |wi.m| = sqrt(eta^2 - 1 + c^2)
//
// The integral of f |cos_i| over wi is the fraction that gets through. Masking is a plain product:
// points seen from above and from below tend to lie at opposite heights. The correlated form for
// one side would let too much through.
//
// Source:  Walter et al. 2007.
#include "common/bsdf/ggx.h"
#include "common/bsdf/lobes.h"

namespace ninefold {

namespace {

float snell2(float c, float eta) { return (eta - 1.0f) * (eta + 1.0f) + c * c; }

// Through a normal m at cosine c = wo.m: eta wi = (c - g) m - wo. nullopt on total reflection.
std::optional<Vec3> refract(Vec3 wo, Vec3 m, float c, float eta) {
  const float g2 = snell2(c, eta);
  if (!(g2 > 0)) return std::nullopt;
  const Vec3 wi = glm::normalize((c - std::sqrt(g2)) * m - wo);
  if (!(wi.z < 0)) return std::nullopt;
  return wi;
}

float refractionPdf(Vec3 wo, Vec3 m, float c, float alpha, float eta) {
  const float g = std::sqrt(std::max(snell2(c, eta), 0.0f));
  const float ratio = (c + g) / ((eta - 1.0f) * (eta + 1.0f));
  return ggx::visibleNormalPdf(wo, m, alpha) * eta * g * ratio * ratio;
}

std::optional<LobeSample> sampleSmooth(const Bsdf& bsdf, Vec3 wo) {
  const Vec3 weight = interfaceTransmittance(bsdf, wo.z);
  if (isBlack(weight)) return std::nullopt;
  if (bsdf.thin || bsdf.eta == 1.0f) return LobeSample{-wo, weight, 0, true};
  const std::optional<Vec3> wi = refract(wo, Vec3(0, 0, 1), wo.z, bsdf.eta);
  if (!wi) return std::nullopt;
  return LobeSample{*wi, weight, 0, true};
}

std::optional<LobeSample> sampleRoughThin(const Bsdf& bsdf, Vec3 wo, Vec3 m) {
  const std::optional<Vec3> up = reflectAbout(wo, m);
  if (!up) return std::nullopt;
  const MirrorLobe lobe = mirrorLobe(wo, *up, m, bsdf.alpha);
  return LobeSample{Vec3(up->x, up->y, -up->z),
                    lobe.masking * interfaceTransmittance(bsdf, lobe.cosine), lobe.pdf, false};
}

std::optional<LobeSample> sampleRough(const Bsdf& bsdf, Vec3 wo, Vec2 u) {
  const Vec3 m = ggx::sampleVisibleNormal(wo, bsdf.alpha, u);
  if (bsdf.thin) return sampleRoughThin(bsdf, wo, m);
  const float c = std::min(glm::dot(wo, m), 1.0f);
  if (!(c > 0)) return std::nullopt;
  const Vec3 passed = interfaceTransmittance(bsdf, c);
  if (isBlack(passed)) return std::nullopt;
  const std::optional<Vec3> wi = refract(wo, m, c, bsdf.eta);
  if (!wi) return std::nullopt;
  return LobeSample{*wi, passed * ggx::masking(*wi, bsdf.alpha),
                    refractionPdf(wo, m, c, bsdf.alpha, bsdf.eta), false};
}

LobeValue evaluateRoughThin(const Bsdf& bsdf, Vec3 wo, Vec3 wi) {
  const Vec3 up(wi.x, wi.y, -wi.z);
  const std::optional<Vec3> m = halfway(wo, up);
  if (!m) return {};
  const MirrorLobe lobe = mirrorLobe(wo, up, *m, bsdf.alpha);
  return {lobe.pdf * lobe.masking * interfaceTransmittance(bsdf, lobe.cosine), lobe.pdf};
}

LobeValue evaluateRough(const Bsdf& bsdf, Vec3 wo, Vec3 wi) {
  if (bsdf.thin) return evaluateRoughThin(bsdf, wo, wi);
  std::optional<Vec3> m = halfway(wo, bsdf.eta * wi);
  if (!m) return {};
  if (m->z < 0) m = -*m;
  const float c = std::min(glm::dot(wo, *m), 1.0f);
  if (!(c > 0) || !(glm::dot(wi, *m) < 0)) return {};
  const float pdf = refractionPdf(wo, *m, c, bsdf.alpha, bsdf.eta);
  return {pdf * ggx::masking(wi, bsdf.alpha) * interfaceTransmittance(bsdf, c), pdf};
}

}  // namespace

TransmissionSplit splitTransmission(const Bsdf& bsdf, float cosThetaO) {
  if (!bsdf.dielectric) return {bsdf.passThrough, 0};
  // A rough interface has no single angle: its tint is the bound that holds at all of them.
  const Vec3 refracted =
      smoothTransmission(bsdf) ? interfaceTransmittance(bsdf, cosThetaO) : bsdf.transmissionTint;
  return {bsdf.passThrough, maxComponent(refracted)};
}

Reflectance straightPass(const Bsdf& bsdf, float cosThetaO) {
  const bool wall = bsdf.dielectric && bsdf.thin && smoothTransmission(bsdf);
  return Vec3(bsdf.passThrough) + (wall ? interfaceTransmittance(bsdf, cosThetaO) : Vec3(0));
}

std::optional<LobeSample> sampleTransmission(const Bsdf& bsdf, Vec3 wo, Vec2 u, float uLobe) {
  const TransmissionSplit split = splitTransmission(bsdf, wo.z);
  const float all = split.straight + split.refracted;
  if (!(all > 0)) return std::nullopt;
  const float chance = split.chance();
  if (uLobe < chance) return LobeSample{-wo, Vec3(all), 0, true};
  std::optional<LobeSample> sample =
      smoothTransmission(bsdf) ? sampleSmooth(bsdf, wo) : sampleRough(bsdf, wo, u);
  if (!sample) return std::nullopt;
  sample->weight /= 1.0f - chance;
  sample->pdf *= 1.0f - chance;
  if (isBlack(sample->weight)) return std::nullopt;
  return sample;
}

LobeValue evaluateTransmission(const Bsdf& bsdf, Vec3 wo, Vec3 wi) {
  if (!bsdf.dielectric || smoothTransmission(bsdf) || !(wi.z < 0)) return {};
  const TransmissionSplit split = splitTransmission(bsdf, wo.z);
  if (!(split.refracted > 0)) return {};
  LobeValue value = evaluateRough(bsdf, wo, wi);
  value.pdf *= 1.0f - split.chance();
  return value;
}

}  // namespace ninefold
