#include "common/gi/eye/eye_path.h"

#include "common/gi/light/direct_light.h"
#include "common/gi/light/light_path.h"

namespace ninefold {
namespace {

// The state of one chain between vertices.
struct Chain {
  ShadingPoint point;
  MediumStack media;
  Reflectance throughput{1};
  float gain = 1;
  float distance = 0;
  uint64_t hash = 0;
  float lobePdf = 0;  // density of the last direction if its lobe is rough, else 0
};

uint16_t foldHash(uint64_t hash) {
  const auto low = static_cast<uint16_t>(hash ^ hash >> 16 ^ hash >> 32 ^ hash >> 48);
  return low == 0 ? uint16_t{1} : low;
}

// Light sampled at a rough vertex into the chosen lobe.
Radiance directAtLobe(const Transport& t, const Chain& c, Lobe lobe, size_t stream, Vec2 u,
                      RayCounts& rays) {
  const ShadingPoint& p = c.point;
  if (p.bsdf.isSmooth()) return Radiance(0);
  const auto light = sampleLight(t, stream, p, u);
  if (!light) return Radiance(0);
  const bool above = glm::dot(light->w, p.ng) > 0;
  if (above != (lobe == Lobe::reflection)) return Radiance(0);
  const LobeValue value = evaluateLobe(p.bsdf, lobe, p.localWo(), p.frame.toLocal(light->w));
  const Vec3 contribution = value.value * light->weight;
  if (isBlack(contribution)) return Radiance(0);
  ++rays.shadow;
  if (t.tracer.occluded(light->origin, light->segment, light->tFar)) return Radiance(0);
  const Vec3 left = lightTransmittance(t, p, c.media, lobe == Lobe::transmission, *light);
  return (light->pdf > 0 ? balance(light->pdf, value.pdf) : 1.0f) * left * contribution;
}

// Emission of the surface that a lobe's ray met, weighted against direct light sampling.
Radiance metEmission(const Transport& t, const Chain& c, const Hit& hit, Vec3 w) {
  const Radiance emitted = emittedRadiance(t, c.point);
  if (isBlack(emitted) || c.lobePdf == 0) return emitted;
  return balance(c.lobePdf, lightPdf(t, hit, c.point.surface, w, hit.t)) * emitted;
}

Radiance metEnvironment(const Transport& t, const Chain& c, Vec3 w) {
  const Radiance l = t.emitters.environment(w);
  if (isBlack(l) || c.lobePdf == 0) return l;
  return balance(c.lobePdf, environmentPdf(t, w)) * l;
}

// Scatters by `lobe` and moves on to the next surface. False: the chain is over, U is complete.
bool step(const Transport& t, Chain& c, Lobe lobe, const PixelSampler& sampler, uint32_t dimension,
          RayCounts& rays, Radiance& unfiltered) {
  const ShadingPoint& p = c.point;
  const auto sample =
      sampleLobe(p.bsdf, lobe, p.localWo(), sampler.get2D(dimension), sampler.get1D(dimension + 3));
  if (!sample) return false;
  const Vec3 wi = glm::normalize(p.frame.toWorld(sample->wi));
  // A direction on the wrong side of the real surface would leak light through it.
  if ((glm::dot(wi, p.ng) > 0) != (lobe == Lobe::reflection)) return false;
  const float excess = std::max(1.0f, maxComponent(sample->weight));
  c.throughput *= sample->weight / excess, c.gain *= excess;
  c.lobePdf = sample->pdf;
  if (isBlack(c.throughput)) return false;
  if (lobe == Lobe::transmission) c.media = t.shader.pass(p, c.media);

  ++rays.eye;
  const Vec3 origin = offsetOrigin(p.surface, wi);
  const Hit hit = t.tracer.closest(origin, wi, std::numeric_limits<float>::infinity());
  if (!hit) {
    unfiltered += c.gain * c.throughput * metEnvironment(t, c, wi);
    return false;
  }
  c.point = t.shader.shade(t.tracer.surface(hit), -wi, c.media);
  c.throughput *= t.shader.attenuation(c.point, c.media, hit.t);
  c.distance += hit.t;
  unfiltered += c.gain * c.throughput * metEmission(t, c, hit, wi);
  return true;
}

void addToHash(Chain& c, Lobe lobe) {
  c.hash = hashWords(
      c.hash, (static_cast<uint64_t>(c.point.surface.instance) << 1) | static_cast<uint64_t>(lobe));
}

}  // namespace

EyePathEnd followLobe(const Transport& t, const ShadingPoint& first, Lobe lobe, float distance,
                      Reflectance through, const MediumStack& media, const PixelSampler& sampler,
                      uint32_t firstDimension, RayCounts& rays) {
  Chain c;
  c.point = first, c.media = media, c.distance = distance, c.throughput = through;
  EyePathEnd end;
  for (int depth = 0; depth < t.settings.specularDepth; ++depth) {
    const uint32_t d = firstDimension + 8 * static_cast<uint32_t>(depth);
    addToHash(c, lobe);
    for (size_t stream = 0; stream < t.streams.count(); ++stream)
      end.unfiltered +=
          c.gain * c.throughput * directAtLobe(t, c, lobe, stream, sampler.get2D(d + 4), rays);
    if (!step(t, c, lobe, sampler, d, rays, end.unfiltered)) break;

    // Pick D, or the lobe to follow.
    const LobeChoice choice = albedoChoice(c.point.bsdf, c.point.localWo().z);
    const float sum = choice.sum();
    if (sum <= 0) break;
    const float u = sampler.get1D(d + 2) * sum;
    if (u < choice.diffuse) {
      c.gain *= sum / choice.diffuse;
      end.arrived = true, end.x = c.point, end.absorber = t.shader.absorber(c.point, c.media);
      end.throughput = c.throughput, end.gain = c.gain;
      end.distance = c.distance, end.chain = foldHash(c.hash);
      break;
    }
    lobe = u < choice.diffuse + choice.reflection ? Lobe::reflection : Lobe::transmission;
    c.gain *= sum / (lobe == Lobe::reflection ? choice.reflection : choice.transmission);
  }
  return end;
}

}  // namespace ninefold
