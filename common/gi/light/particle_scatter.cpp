#include "common/gi/light/particle_scatter.h"

namespace ninefold {
namespace {

// Probability of the lobe about ng.
float geometricChance(const ShadingPoint& p) {
  if (p.ns == p.ng) return 0;
  if (!facesNormal(p.ns, p.wo)) return 1;
  return std::min(0.5f * glm::length(p.ns - p.ng), 0.5f);
}

}  // namespace

std::optional<ScatteredParticle> scatterParticle(const ShadingPoint& p, Lobe lobe, Vec2 u,
                                                 float uLobe, float uNormal) {
  const float chance = geometricChance(p);
  const bool geometric = uNormal < chance;
  const Basis frame(geometric ? p.ng : p.ns);
  const auto sample = sampleLobe(p.bsdf, lobe, frame.toLocal(p.wo), u, uLobe);
  if (!sample) return std::nullopt;
  const Vec3 wi = glm::normalize(frame.toWorld(sample->wi));
  const float side = lobe == Lobe::reflection ? 1.0f : -1.0f;
  const float g = side * glm::dot(wi, p.ng), s = side * glm::dot(wi, frame.normal);
  if (g <= 0 || s <= 0) return std::nullopt;
  if (p.ns != p.ng && geometric == facesNormal(side * p.ns, wi)) return std::nullopt;
  const float factor = shadingFactor(p, frame.normal, p.wo) * g / s;
  return ScatteredParticle{wi, factor / (geometric ? chance : 1 - chance) * sample->weight,
                           sample->smooth};
}

}  // namespace ninefold
