// reflection.cpp: the mirror lobe: f cos_i = F D G2 / (4 cos_o), sampled by visible normals.
#include <limits>

#include "common/bsdf/ggx.h"
#include "common/bsdf/lobes.h"

namespace ninefold {

// p(wi) = p(m)/(4 wo.m) = G1(wo)/cos_o D/4 and f cos_i / p = F G2/G1(wo), free of divided cosines.
MirrorLobe mirrorLobe(Vec3 wo, Vec3 wi, Vec3 m, float alpha) {
  const float so = ggx::slope(wo, alpha), si = ggx::slope(wi, alpha);
  return {std::min(glm::dot(wo, m), 1.0f), wi.z * (wo.z + so) / (so * wi.z + si * wo.z),
          0.25f * ggx::maskingOverCos(wo, alpha) * ggx::distribution(m, alpha)};
}

std::optional<Vec3> halfway(Vec3 wo, Vec3 wi) {
  const Vec3 h = wo + wi;
  const float length2 = glm::dot(h, h);
  if (!(length2 > std::numeric_limits<float>::min())) return std::nullopt;
  return h / std::sqrt(length2);
}

std::optional<Vec3> reflectAbout(Vec3 wo, Vec3 m) {
  const Vec3 wi = glm::normalize(2.0f * glm::dot(wo, m) * m - wo);
  if (!(wi.z > 0)) return std::nullopt;
  return wi;
}

std::optional<LobeSample> sampleReflection(const Bsdf& bsdf, Vec3 wo, Vec2 u) {
  LobeSample sample{};
  if (smoothReflection(bsdf)) {
    sample = {Vec3(-wo.x, -wo.y, wo.z), interfaceReflectance(bsdf, wo.z), 0, true};
  } else {
    const Vec3 m = ggx::sampleVisibleNormal(wo, bsdf.alpha, u);
    const std::optional<Vec3> wi = reflectAbout(wo, m);
    if (!wi) return std::nullopt;
    const MirrorLobe lobe = mirrorLobe(wo, *wi, m, bsdf.alpha);
    sample = {*wi, lobe.masking * interfaceReflectance(bsdf, lobe.cosine), lobe.pdf, false};
  }
  if (isBlack(sample.weight)) return std::nullopt;
  return sample;
}

LobeValue evaluateReflection(const Bsdf& bsdf, Vec3 wo, Vec3 wi) {
  if (smoothReflection(bsdf) || !(wi.z > 0)) return {};
  const std::optional<Vec3> m = halfway(wo, wi);
  if (!m) return {};
  const MirrorLobe lobe = mirrorLobe(wo, wi, *m, bsdf.alpha);
  return {lobe.pdf * lobe.masking * interfaceReflectance(bsdf, lobe.cosine), lobe.pdf};
}

}  // namespace ninefold
