#include "common/gi/vpl/vpl_roulette.h"

#include <bit>

namespace ninefold {
namespace {

// So many VPLs are taken on average at least, if there are any: fewer are too noisy.
constexpr int kLeast = 5;
// Nobody's chance is less: what would add next to nothing may be all that is not hidden.
constexpr float kLeastChance = 1.0f / 16;

// Weights are not negative, so their bits are ordered as they are; whole numbers are compared by
// whole vectors.
float largest(const float* weight) {
  uint32_t most = 0;
  for (int lane = 0; lane < kPacket; ++lane)
    most = std::max(most, std::bit_cast<uint32_t>(weight[lane]));
  return std::bit_cast<float>(most);
}

void scale(float* weight, float by) {
  for (int lane = 0; lane < kPacket; ++lane) weight[lane] *= by;
}

// Largest component of what goes to x [W/sr].
float brightness(const VplSet& lights, const Vpl& vpl, Vec3 x) {
  const float diffuse = maxComponent(vpl.power);
  if (vpl.glossy < 0 || x == vpl.position) return diffuse;
  const GlossyVpl& glossy = lights.glossy[static_cast<size_t>(vpl.glossy)];
  // At least a twentieth of diffuse scattering: the rest of the packet is seen from elsewhere.
  return diffuse +
         std::max(maxComponent(glossy.intensityOverCosine(glm::normalize(x - vpl.position))),
                  0.05f * kInvPi * maxComponent(glossy.flux));
}

}  // namespace

void VplRoulette::play(float f, const VplSet& lights, const ReceiverSamples& samples,
                       int pathVertices, const Receivers& receivers, size_t begin,
                       VplWeights& weights) {
  if (f <= 0) return;
  for (size_t first = 0; first < weights.size(); first += kPacket)
    playPacket(f, lights, samples.vplChoice(receivers.pixel[begin + first], pathVertices),
               receivers.position(begin + first), first, weights);
}

void VplRoulette::playPacket(float f, const VplSet& lights, float u, Vec3 x, size_t first,
                             VplWeights& weights) {
  const std::vector<Vpl>& vpls = lights.vpls;
  contributions_.resize(vpls.size());
  float sum = 0;
  int count = 0;
  for (size_t v = 0; v < vpls.size(); ++v) {
    const float c = vpls[v].seen * brightness(lights, vpls[v], x) * largest(weights.at(v, first));
    contributions_[v] = c, sum += c, count += c > 0 ? 1 : 0;
  }
  if (count <= kLeast) return;
  const float tau = sum / std::max(static_cast<float>(count) / f, float{kLeast});
  for (size_t v = 0; v < vpls.size(); ++v) {
    const float c = contributions_[v];
    if (c <= 0 || c >= tau) continue;
    const float p = std::max(c / tau, kLeastChance);
    u += p;
    const bool taken = u >= 1;
    if (taken) u -= 1;
    scale(weights.at(v, first), taken ? 1 / p : 0.0f);
  }
}

}  // namespace ninefold
