#include "common/scene/material_check.h"

#include "common/base/error.h"
#include "common/base/log.h"

namespace ninefold {
namespace {

// Emission beyond this would overflow products of fluxes in single precision.
constexpr float kLargestRadiance = 1e12f;
constexpr float kLargestIor = 1e4f;

void checkRange(float value, float low, float high, const std::string& what, const char* name) {
  if (!(value >= low && value <= high))
    fail("{}: its {} is {}, it must lie between {} and {}", what, name, value, low, high);
}

void checkColour(Vec3 value, float high, const std::string& what, const char* name) {
  for (int c = 0; c < 3; ++c) checkRange(value[c], 0, high, what, name);
}

void checkUse(const Scene& scene, const TextureUse& use, bool srgb, const std::string& what,
              const char* name) {
  if (use.image < -1 || (use && static_cast<size_t>(use.image) >= scene.images.size()))
    fail("{}: image {} of its {} does not exist", what, use.image, name);
  if (use && scene.images[static_cast<size_t>(use.image)].srgb != srgb)
    fail("{}: the image of its {} is decoded the wrong way", what, name);
  if (use.uvSet < 0 || use.uvSet > 1 || use.wrapS > Wrap::mirror || use.wrapT > Wrap::mirror)
    fail("{}: its {} is looked up in an unknown way", what, name);
  if (!std::isfinite(use.offset.x + use.offset.y + use.scale.x + use.scale.y + use.rotation))
    fail("{}: the transform of its {} is not a finite number", what, name);
}

void checkMaps(const Scene& scene, const Material& m, const std::string& what) {
  checkUse(scene, m.baseColorMap, true, what, "base colour");
  checkUse(scene, m.metallicRoughnessMap, false, what, "roughness");
  checkUse(scene, m.normalMap, false, what, "normal map");
  checkUse(scene, m.emissionMap, true, what, "emission");
  checkUse(scene, m.transmissionMap, false, what, "transmission");
  checkUse(scene, m.specularMap, false, what, "specular");
  checkUse(scene, m.specularColorMap, true, what, "specular colour");
  checkUse(scene, m.sheenColorMap, true, what, "sheen");
  checkUse(scene, m.sheenRoughnessMap, false, what, "sheen roughness");
  checkUse(scene, m.coatMap, false, what, "clear coat");
  checkUse(scene, m.coatRoughnessMap, false, what, "clear coat's roughness");
}

// Leaves NaN as it is: the check tells it.
void clampFactor(float& value, float high, const std::string& what, const char* name) {
  constexpr float kRounding = 1e-3f;
  const float clamped = std::clamp(value, 0.0f, high);
  if (std::abs(clamped - value) > kRounding)
    warn("{}: its {} is {:.4g} and read as {:.4g}", what, name, value, clamped);
  if (!std::isnan(value)) value = clamped;
}

void clampColour(Vec3& value, float high, const std::string& what, const char* name) {
  for (int c = 0; c < 3; ++c) clampFactor(value[c], high, what, name);
}

}  // namespace

void clampFactors(Material& m, const std::string& what) {
  constexpr float kAny = std::numeric_limits<float>::max();
  clampColour(m.baseColor, 1, what, "base colour");
  clampFactor(m.opacity, 1, what, "opacity");
  clampFactor(m.alphaCutoff, kAny, what, "alpha cutoff");
  clampFactor(m.metallic, 1, what, "metallic factor");
  clampFactor(m.roughness, 1, what, "roughness");
  clampColour(m.emission, kAny, what, "emission");
  clampFactor(m.transmission, 1, what, "transmission");
  clampFactor(m.specular, 1, what, "specular factor");
  clampColour(m.specularColor, kAny, what, "specular colour");
  clampColour(m.attenuationColor, 1, what, "attenuation colour");
  clampColour(m.sheenColor, 1, what, "sheen");
  clampFactor(m.sheenRoughness, 1, what, "sheen roughness");
  clampFactor(m.coat, 1, what, "clear coat");
  clampFactor(m.coatRoughness, 1, what, "clear coat's roughness");
}

void warnOfLostLayers(const Material& m) {
  if (!transmits(m) || (m.coat == 0 && isBlack(m.sheenColor))) return;
  warn("material '{}': coat and sheen are left out, as light passes through it", m.name);
}

void checkMaterial(const Scene& scene, const Material& m, const std::string& what) {
  constexpr float kAny = std::numeric_limits<float>::max();
  checkColour(m.baseColor, 1, what, "base colour");
  checkRange(m.opacity, 0, 1, what, "opacity");
  if (m.alphaMode > AlphaMode::blend) fail("{}: unknown alpha mode", what);
  checkRange(m.alphaCutoff, 0, kAny, what, "alpha cutoff");
  checkRange(m.metallic, 0, 1, what, "metallic factor");
  checkRange(m.roughness, 0, 1, what, "roughness");
  checkRange(m.normalScale, -kAny, kAny, what, "normal scale");
  checkColour(m.emission, kLargestRadiance, what, "emission");
  checkRange(m.transmission, 0, 1, what, "transmission");
  checkRange(m.ior, 1 / kLargestIor, kLargestIor, what, "index of refraction");
  checkRange(m.specular, 0, 1, what, "specular factor");
  checkColour(m.specularColor, kAny, what, "specular colour");
  checkColour(m.attenuationColor, 1, what, "attenuation colour");
  checkColour(m.sheenColor, 1, what, "sheen");
  checkRange(m.sheenRoughness, 0, 1, what, "sheen roughness");
  checkRange(m.coat, 0, 1, what, "clear coat");
  checkRange(m.coatRoughness, 0, 1, what, "clear coat's roughness");
  if (!(m.attenuationDistance > 0)) fail("{}: its attenuation distance must be above 0", what);
  checkMaps(scene, m, what);
}

}  // namespace ninefold
