#include "common/bsdf/layers.h"

#include "common/bsdf/lobes.h"
#include "common/bsdf/sheen.h"

namespace ninefold {
namespace {

// A coat is a surface of its own.
Bsdf coatOf(const Bsdf& bsdf) {
  Bsdf coat;
  coat.reflects = true;
  coat.alpha = bsdf.coatAlpha;
  coat.f0 = Vec3(kCoatReflectance * bsdf.coat), coat.f90 = Vec3(bsdf.coat);
  return coat;
}

// T_c, T_s and their product if both directions are `cosine`; the less of two holds for a pair.
struct Through {
  float coat, sheen;
};
Through through(const Bsdf& bsdf, float cosine) {
  const float coat = bsdf.coat > 0 ? 1 - interfaceReflectance(coatOf(bsdf), cosine).x : 1.0f;
  const float colour = maxComponent(bsdf.sheen);
  return {coat, colour > 0 ? 1 - colour * sheen::albedo(cosine, bsdf.sheenAlpha) : 1.0f};
}
Through through(const Bsdf& bsdf, Vec3 wo, Vec3 wi) {
  const Through o = through(bsdf, wo.z), i = through(bsdf, wi.z);
  return {std::min(o.coat, i.coat), std::min(o.sheen, i.sheen)};
}

// Albedos of the three parts.
struct Parts {
  Reflectance coat{0}, sheen{0}, base{0};
};
Parts partsOf(const Bsdf& bsdf, float cosine) {
  const Through left = through(bsdf, cosine);
  Parts parts;
  if (bsdf.coat > 0) parts.coat = ggxAlbedo(coatOf(bsdf), cosine);
  if (!isBlack(bsdf.sheen))
    parts.sheen = left.coat * sheen::albedo(cosine, bsdf.sheenAlpha) * bsdf.sheen;
  if (!isBlack(bsdf.f90)) parts.base = left.coat * left.sheen * ggxAlbedo(bsdf, cosine);
  return parts;
}

// Probabilities of the parts; all 0 if nothing reflects.
struct Chances {
  float coat = 0, sheen = 0, base = 0;
};
Chances chancesOf(const Bsdf& bsdf, float cosine) {
  const Parts parts = partsOf(bsdf, cosine);
  const Chances all{maxComponent(parts.coat), maxComponent(parts.sheen), maxComponent(parts.base)};
  const float sum = all.coat + all.sheen + all.base;
  if (!(sum > 0)) return {};
  return {all.coat / sum, all.sheen / sum, all.base / sum};
}

LobeValue evaluate(const Bsdf& bsdf, const Chances& chances, Vec3 wo, Vec3 wi) {
  const Through left = through(bsdf, wo, wi);
  LobeValue all;
  const auto add = [&](float chance, float weight, const LobeValue& part) {
    all.value += weight * part.value, all.pdf += chance * part.pdf;
  };
  if (chances.coat > 0) add(chances.coat, 1, evaluateReflection(coatOf(bsdf), wo, wi));
  if (chances.base > 0) add(chances.base, left.coat * left.sheen, evaluateReflection(bsdf, wo, wi));
  if (chances.sheen > 0)
    add(chances.sheen, left.coat,
        {sheen::value(wo, wi, bsdf.sheenAlpha) * bsdf.sheen, sheen::kPdf});
  return all;
}

Vec3 evenly(Vec2 u) {
  const float r = std::sqrt((1 - u.x) * (1 + u.x)), phi = 2 * kPi * u.y;
  return Vec3(r * std::cos(phi), r * std::sin(phi), u.x);
}

}  // namespace

std::optional<LobeSample> sampleLayers(const Bsdf& bsdf, Vec3 wo, Vec2 u, float uLobe) {
  const Chances chances = chancesOf(bsdf, std::min(wo.z, 1.0f));
  const bool isCoat = uLobe < chances.coat, isBase = !isCoat && uLobe < chances.coat + chances.base;
  LobeSample sample{evenly(u), Vec3(0), 0, false};
  if (isCoat || isBase) {
    const auto part = sampleReflection(isCoat ? coatOf(bsdf) : bsdf, wo, u);
    if (!part) return std::nullopt;
    sample = *part;
  }
  if (sample.smooth) {
    const Through left = through(bsdf, wo, sample.wi);
    const float share = isCoat ? 1 : left.coat * left.sheen;
    sample.weight = share * sample.weight / (isCoat ? chances.coat : chances.base);
    return sample;
  }
  if (!(sample.wi.z > 0)) return std::nullopt;
  const LobeValue all = evaluate(bsdf, chances, wo, sample.wi);
  if (!(all.pdf > 0) || isBlack(all.value)) return std::nullopt;
  return LobeSample{sample.wi, all.value / all.pdf, all.pdf, false};
}

LobeValue evaluateLayers(const Bsdf& bsdf, Vec3 wo, Vec3 wi) {
  if (!(wi.z > 0)) return {};
  return evaluate(bsdf, chancesOf(bsdf, std::min(wo.z, 1.0f)), wo, wi);
}

Reflectance layersAlbedo(const Bsdf& bsdf, float cosThetaO) {
  const Parts parts = partsOf(bsdf, cosThetaO);
  return parts.coat + parts.sheen + parts.base;
}

}  // namespace ninefold
