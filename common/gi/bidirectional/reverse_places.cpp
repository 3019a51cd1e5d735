#include "common/gi/bidirectional/reverse_places.h"

#include "common/sampling/sampler.h"
#include "common/sampling/warp.h"

namespace ninefold {

std::vector<ReversePlace> reversePlaces(const Transport& t, const Receivers& x,
                                        const FrameKey& frame, int k, int count, RayCounts& rays) {
  std::vector<ReversePlace> found;
  if (x.size() == 0 || count <= 0) return found;
  const LightSampler sampler(t.settings.seed, SampleUse::reverseVpl, frame.randomization,
                             static_cast<uint32_t>(k), log2Ceil(count), t.settings.randomization);
  for (uint32_t j = 0; j < static_cast<uint32_t>(count); ++j) {
    const size_t i = std::min(
        static_cast<size_t>(sampler.get1D(j, 2) * static_cast<float>(x.size())), x.size() - 1);
    const Vec3 w =
        glm::normalize(Basis(x.ng(i)).toWorld(squareToCosineHemisphere(sampler.get2D(j, 0))));
    ++rays.photon;
    const Hit hit = t.tracer.closest(x.origin(i), w, std::numeric_limits<float>::infinity());
    if (!hit) continue;
    const ShadingPoint y = t.shader.shade(t.tracer.surface(hit), -w, {});
    if (isBlack(y.bsdf.diffuse)) continue;
    const float cosines = glm::dot(w, x.ng(i)) * glm::dot(-w, y.ng);
    found.push_back({{y.surface.position, y.ng, y.surface.error},
                     receiverAt(y, j, x.absorber[i]),
                     y.bsdf.diffuse,
                     static_cast<int>(i),
                     kInvPi * cosines / (hit.t * hit.t)});
  }
  return found;
}

}  // namespace ninefold
