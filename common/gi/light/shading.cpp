#include "common/gi/light/shading.h"

#include "common/gi/light/solid_ranks.h"
#include "common/scene/texture.h"

namespace ninefold {
namespace {

Vec3 mix(Vec3 a, Vec3 b, float t) { return a + t * (b - a); }

Vec3 attenuationCoefficient(const Material& m) {
  if (!m.solid || !std::isfinite(m.attenuationDistance)) return Vec3(0);
  const auto sigma = [&](float colour) {
    return -std::log(std::clamp(colour, 1e-6f, 1.0f)) / m.attenuationDistance;
  };
  return Vec3(sigma(m.attenuationColor.x), sigma(m.attenuationColor.y),
              sigma(m.attenuationColor.z));
}

bool mayBeDiffuseOf(const Material& m, bool folds) {
  const bool metal = m.metallic >= 1 && !m.metallicRoughnessMap;
  const bool glass = m.transmission >= 1 && !m.transmissionMap;
  return !isBlack(m.baseColor) && (folds || (!metal && !glass));
}

}  // namespace

MeanReflection::MeanReflection() {
  for (int i = 0; i <= kSteps; ++i) {
    const float roughness = static_cast<float>(i) / kSteps;
    const float alpha = roughness * roughness;
    ends_[static_cast<size_t>(i)] = {meanReflection(Vec3(0), alpha).x,
                                     meanReflection(Vec3(1), alpha).x};
  }
}

Reflectance MeanReflection::operator()(Vec3 f0, Vec3 f90, float alpha) const {
  const float at = std::sqrt(std::clamp(alpha, 0.0f, 1.0f)) * kSteps;
  const auto i = std::min(static_cast<size_t>(at), static_cast<size_t>(kSteps - 1));
  const float part = at - static_cast<float>(i);
  const float black = ends_[i].black + part * (ends_[i + 1].black - ends_[i].black);
  const float white = ends_[i].white + part * (ends_[i + 1].white - ends_[i].white);
  return black * f90 + (white - black) * f0;
}

Shader::Shader(const Scene& scene) : scene_(&scene) {
  const std::vector<int> ranks = solidRanks(scene);
  for (size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& m = scene.materials[i];
    Prepared p;
    p.rank = ranks[i];
    p.fixedEnds = !m.specularMap && !m.specularColorMap;
    if (p.fixedEnds) p.ends = dielectricEnds(m, {});
    p.fixedMean = p.fixedEnds && !m.metallicRoughnessMap;
    if (p.fixedMean) p.mean = coatReflection(p.ends, m.roughness * m.roughness);
    p.transmits = transmits(m);
    p.folds = !p.transmits && foldsIntoDiffuse(scene, m);
    p.layered = hasCoat(m) || hasSheen(m);
    p.focuses = focusesLight(scene, m);
    p.passes = letsPassStraight(scene, m);
    p.diffuse = mayBeDiffuseOf(m, p.folds);
    p.sigma = attenuationCoefficient(m);
    p.meanFresnel = p.transmits ? meanFresnelDielectric(m.ior) : 0;
    materials_.push_back(p);
  }
}

float Shader::indexOf(int material) const {
  return material == MediumStack::kAir ? 1.0f
                                       : scene_->materials[static_cast<size_t>(material)].ior;
}

Vec3 Shader::shadingNormal(const SurfacePoint& s, Vec3 ng) const {
  const Material& material = scene_->materials[static_cast<size_t>(s.material)];
  Vec3 n = s.shadingNormal;
  if (material.normalMap) {
    const Vec4 t = lookUp(*scene_, material.normalMap, s.uv0, s.uv1);
    const Vec2 slope = material.normalScale * Vec2(2 * t.x - 1, 2 * t.y - 1);
    const Vec3 bitangent = s.tangentSign * glm::cross(n, s.tangent);
    const Vec3 bent = slope.x * s.tangent + slope.y * bitangent + std::max(2 * t.z - 1, 1e-3f) * n;
    if (glm::dot(bent, bent) > 0) n = glm::normalize(bent);
  }
  if (glm::dot(s.geometricNormal, ng) < 0) n = -n;
  return glm::dot(n, ng) > 0 ? n : ng;
}

Shader::FresnelEnds Shader::dielectricEnds(const Material& m, const SurfacePoint& s) const {
  const float r = (m.ior - 1) / (m.ior + 1);
  Vec3 f0 = r * r * m.specularColor;
  if (m.specularColorMap) f0 *= Vec3(lookUp(*scene_, m.specularColorMap, s.uv0, s.uv1));
  float strength = m.specular;
  if (m.specularMap) strength *= lookUp(*scene_, m.specularMap, s.uv0, s.uv1).w;
  return {strength * glm::min(f0, Vec3(1)), Vec3(strength)};
}

Reflectance Shader::coatReflection(const FresnelEnds& ends, float alpha) const {
  return isBlack(ends.f90) ? Vec3(0) : meanReflection_(ends.f0, ends.f90, alpha);
}

void Shader::fillOpaque(Bsdf& bsdf, const Material& m, const Prepared& prepared, Vec3 base,
                        float metallic, float alpha, const SurfacePoint& s) const {
  const FresnelEnds dielectric = prepared.fixedEnds ? prepared.ends : dielectricEnds(m, s);
  const Vec3 mean = prepared.fixedMean ? prepared.mean : coatReflection(dielectric, alpha);
  bsdf.f0 = mix(dielectric.f0, base, metallic);
  bsdf.f90 = mix(dielectric.f90, Vec3(1), metallic);
  bsdf.diffuse = (1 - metallic) * (Vec3(1) - mean) * base;
  bsdf.reflects = !prepared.folds && !isBlack(bsdf.f90);
  if (!prepared.folds) return;
  const Vec3 metal = metallic > 0 ? meanReflection_(base, Vec3(1), alpha) : Vec3(0);
  bsdf.diffuse = glm::min(bsdf.diffuse + mix(mean, metal, metallic), Vec3(1));
}

void Shader::addLayers(Bsdf& bsdf, const Material& m, bool folds, const SurfacePoint& s) const {
  if (folds || !bsdf.reflects) bsdf.f0 = bsdf.f90 = Vec3(0);
  const auto texel = [&](const TextureUse& use) {
    return use ? lookUp(*scene_, use, s.uv0, s.uv1) : Vec4(1);
  };
  bsdf.coat = hasCoat(m) ? m.coat * texel(m.coatMap).x : 0;
  bsdf.sheen = m.sheenColor * Vec3(texel(m.sheenColorMap));
  const float coatRoughness = m.coatRoughness * texel(m.coatRoughnessMap).y;
  const float sheenRoughness = m.sheenRoughness * texel(m.sheenRoughnessMap).w;
  const float coatAlpha = coatRoughness * coatRoughness;
  bsdf.coatAlpha = coatAlpha < kSmoothAlpha ? 0.0f : coatAlpha;
  bsdf.sheenAlpha = std::clamp(sheenRoughness * sheenRoughness, kLeastSheenAlpha, 1.0f);
  const float coatMean = meanReflection_(Vec3(kCoatReflectance), Vec3(1), bsdf.coatAlpha).x;
  bsdf.diffuse *=
      (1 - bsdf.coat * coatMean) * (1 - maxComponent(bsdf.sheen) * meanSheen(bsdf.sheenAlpha));
  bsdf.layered = bsdf.coat > 0 || !isBlack(bsdf.sheen);
  bsdf.reflects = bsdf.layered || !isBlack(bsdf.f90);
}

void Shader::fillTransmitting(Bsdf& bsdf, const Material& m, const Prepared& prepared, Vec3 base,
                              float metallic, const SurfacePoint& s) const {
  float share = m.transmission;
  if (m.transmissionMap) share *= lookUp(*scene_, m.transmissionMap, s.uv0, s.uv1).x;
  base *= 1 - metallic;
  float strength = m.specular;
  if (m.specularMap) strength *= lookUp(*scene_, m.specularMap, s.uv0, s.uv1).w;
  bsdf.dielectric = true;
  bsdf.reflectionTint = strength * m.specularColor;
  if (m.specularColorMap)
    bsdf.reflectionTint *= Vec3(lookUp(*scene_, m.specularColorMap, s.uv0, s.uv1));
  bsdf.reflectionTint = glm::min(bsdf.reflectionTint, Vec3(1));
  bsdf.transmissionTint = share * base;
  bsdf.diffuse = (1 - share) * (1 - prepared.meanFresnel) * base;
  bsdf.reflects = !isBlack(bsdf.reflectionTint);
}

ShadingPoint Shader::shade(const SurfacePoint& s, Vec3 wo, const MediumStack& media) const {
  const Material& m = scene_->materials[static_cast<size_t>(s.material)];
  const Prepared& prepared = materials_[static_cast<size_t>(s.material)];
  ShadingPoint p;
  p.surface = s;
  p.wo = wo;
  p.front = glm::dot(wo, s.geometricNormal) >= 0;
  p.ng = p.front ? s.geometricNormal : -s.geometricNormal;
  p.ns = shadingNormal(s, p.ng);
  p.frame = Basis(facesNormal(p.ns, wo) ? p.ns : p.ng);

  Vec3 base = m.baseColor * Vec3(s.color);
  float opacity = m.opacity * s.color.w;
  if (m.baseColorMap) {
    const Vec4 t = lookUp(*scene_, m.baseColorMap, s.uv0, s.uv1);
    base *= Vec3(t);
    opacity *= t.w;
  }
  float metallic = m.metallic, roughness = m.roughness;
  if (m.metallicRoughnessMap) {
    const Vec4 t = lookUp(*scene_, m.metallicRoughnessMap, s.uv0, s.uv1);
    roughness *= t.y, metallic *= t.z;
  }
  const float alpha = roughness * roughness;
  p.bsdf.alpha = alpha < kSmoothAlpha ? 0.0f : alpha;
  p.bsdf.thin = !m.solid;
  if (prepared.transmits) {
    const int outside = before(p, media), inside = pass(p, media).innermost();
    if (m.solid && inside == outside) {  // within another solid that counts
      p.ns = p.ng, p.frame = Basis(p.ng);
      p.bsdf.passThrough = 1;
      return p;
    }
    fillTransmitting(p.bsdf, m, prepared, base, metallic, s);
    p.bsdf.eta = m.solid ? indexOf(inside) / indexOf(outside) : m.ior;
  } else {
    fillOpaque(p.bsdf, m, prepared, base, metallic, alpha, s);
    if (prepared.layered) addLayers(p.bsdf, m, prepared.folds, s);
  }
  if (m.alphaMode == AlphaMode::blend) {
    opacity = std::clamp(opacity, 0.0f, 1.0f);
    p.bsdf.diffuse *= opacity, p.bsdf.f0 *= opacity, p.bsdf.f90 *= opacity;
    p.bsdf.reflectionTint *= opacity, p.bsdf.transmissionTint *= opacity;
    p.bsdf.coat *= opacity, p.bsdf.sheen *= opacity;
    p.bsdf.passThrough = 1 - opacity;
  }
  return p;
}

Vec3 Shader::transmittance(int material, float distance) const {
  if (material == MediumStack::kAir) return Vec3(1);
  const Vec3 sigma = materials_[static_cast<size_t>(material)].sigma;
  if (isBlack(sigma)) return Vec3(1);
  const auto left = [&](float s) { return s == 0 ? 1.0f : std::exp(-s * distance); };
  return Vec3(left(sigma.x), left(sigma.y), left(sigma.z));
}

int Shader::absorber(const ShadingPoint& p, const MediumStack& media) const {
  const int medium = before(p, media);
  if (medium == MediumStack::kAir) return medium;
  return isBlack(materials_[static_cast<size_t>(medium)].sigma) ? MediumStack::kAir : medium;
}

bool Shader::isSolid(int material) const {
  return scene_->materials[static_cast<size_t>(material)].solid &&
         materials_[static_cast<size_t>(material)].transmits;
}

bool Shader::neverEntered(const ShadingPoint& p, const MediumStack& media) const {
  return !p.front && isSolid(p.surface.material) && !media.contains(p.surface.material);
}

int Shader::before(const ShadingPoint& p, const MediumStack& media) const {
  if (!neverEntered(p, media)) return media.innermost();
  MediumStack all = media;
  enter(all, p.surface.material);
  return all.innermost();
}

void Shader::enter(MediumStack& media, int material) const {
  media.enter(material, materials_[static_cast<size_t>(material)].rank);
}

float Shader::squaredIndex(const MediumStack& media) const {
  const float n = indexOf(media.innermost());
  return n * n;
}

MediumStack Shader::pass(const ShadingPoint& p, MediumStack media) const {
  forEachCrossed(p.surface, p.front, [&](int material, bool enters) {
    enters ? enter(media, material) : media.leave(material);
  });
  return media;
}

}  // namespace ninefold
