#include "common/gi/vpl/glossy_vpl.h"

namespace ninefold {

Vec3 GlossyVpl::intensityOverCosine(Vec3 v) const {
  const float lightG = glm::dot(towardsLight, ng);
  if (!(lightG > 0) || !(glm::dot(v, ng) > 0)) return Vec3(0);
  const Basis frame(facesNormal(ns, v) ? ns : ng);
  const Vec3 in = frame.toLocal(towardsLight), out = frame.toLocal(v);
  if (!(in.z > 0) || !(out.z > 0)) return Vec3(0);
  // f |v.n|, sampled the other way about.
  const Vec3 value = evaluateLobe(bsdf, Lobe::reflection, in, out).value;
  return in.z / (lightG * out.z) * value * flux;
}

}  // namespace ninefold
