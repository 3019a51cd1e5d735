#include "common/scene/needs.h"

#include "common/image/layers.h"
#include "common/scene/texel_ranges.h"

namespace ninefold {
namespace {

// Smallest and largest value of one channel of a map, in [0, 1]; {1, 1} without a map.
struct Range {
  float low = 1, high = 1;
};

Range channelRange(const Scene& scene, const TextureUse& use, int channel) {
  if (!use) return {};
  const TextureImage& image = scene.images[static_cast<size_t>(use.image)];
  const int stored = image.channels >= 3 ? channel : (channel == 3 ? 1 : 0);
  if (stored >= image.channels) return {};  // alpha of an image that has none
  const ChannelRange range = texelRanges(image)[static_cast<size_t>(stored)];
  return {static_cast<float>(range.low) / 255.0f, static_cast<float>(range.high) / 255.0f};
}

float largestMetallic(const Scene& scene, const Material& m) {
  return m.metallic == 0 ? 0 : m.metallic * channelRange(scene, m.metallicRoughnessMap, 2).high;
}

// Perceptual roughness.
Range roughness(const Scene& scene, const Material& m) {
  const Range texels = channelRange(scene, m.metallicRoughnessMap, 1);
  return {m.roughness * texels.low, m.roughness * texels.high};
}

bool blends(const Scene& scene, const Material& m) {
  return m.alphaMode == AlphaMode::blend &&
         m.opacity * channelRange(scene, m.baseColorMap, 3).low < 1;
}

bool blendsByVertex(const Scene& scene, const Mesh& mesh) {
  return scene.materials[static_cast<size_t>(mesh.material)].alphaMode == AlphaMode::blend &&
         std::ranges::any_of(mesh.colors, [](const Vec4& color) { return color.w < 1; });
}

bool isTextured(const Material& m) {
  return std::ranges::any_of(mapsOf(m), [](const TextureUse* use) { return bool(*use); });
}

// GGX alpha = roughness^2; below this it counts as smooth, as in bsdf/bsdf.h.
constexpr float kSmallestAlpha = 1e-3f;

void addLayers(const Scene& scene, const Material& m, Needs& needs) {
  if (hasSheen(m)) needs.reflection = needs.roughSpecular = needs.glossy = true;
  if (!hasCoat(m)) return;
  const Range texels = channelRange(scene, m.coatRoughnessMap, 1);
  const float smoothest = m.coatRoughness * texels.low, roughest = m.coatRoughness * texels.high;
  needs.reflection = true;
  needs.roughSpecular |= roughest * roughest >= kSmallestAlpha;
  needs.smoothSpecular |= smoothest * smoothest < kSmallestAlpha;
}

void addMaterial(const Scene& scene, const Material& m, Needs& needs) {
  const bool glass = transmits(m);
  const bool lobe = glass || !foldsIntoDiffuse(scene, m);
  const auto [smoothest, roughest] = roughness(scene, m);
  needs.reflection |= lobe;
  needs.transmission |= glass || blends(scene, m);
  needs.roughSpecular |= lobe && roughest * roughest >= kSmallestAlpha;
  needs.smoothSpecular |= (lobe && smoothest * smoothest < kSmallestAlpha) || blends(scene, m);
  needs.glossy |= lobe && !glass && roughest >= kGlossyRoughness;
  addLayers(scene, m, needs);
  needs.caustics |= focusesLight(scene, m);
  needs.textures |= isTextured(m);
  needs.alphaMask |= m.alphaMode == AlphaMode::mask;
  needs.areaLights |= !isBlack(m.emission);
}

}  // namespace

uint8_t Needs::layerMask() const {
  return static_cast<uint8_t>(kDiffuseBit | (reflection ? kReflectionBit : 0) |
                              (transmission ? kTransmissionBit : 0));
}

bool foldsIntoDiffuse(const Scene& scene, const Material& m) {
  const float metallic = largestMetallic(scene, m);
  if (metallic == 0 && m.specular == 0) return true;
  return roughness(scene, m).low >= (metallic < 0.5f ? 0.6f : 0.85f);
}

bool letsPassStraight(const Scene& scene, const Material& m) {
  if (transmits(m)) return !m.solid;
  return blends(scene, m);
}

bool focusesLight(const Scene& scene, const Material& m) {
  if (transmits(m) || hasCoat(m)) return true;
  return !foldsIntoDiffuse(scene, m) && roughness(scene, m).low < kGlossyRoughness;
}

Needs needsOf(const Scene& scene, Radiance environment) {
  Needs needs;
  std::vector<char> used(scene.materials.size(), 0);
  for (const Instance& instance : scene.instances)
    used[static_cast<size_t>(scene.meshes[static_cast<size_t>(instance.mesh)].material)] = 1;
  for (size_t i = 0; i < used.size(); ++i)
    if (used[i] != 0) addMaterial(scene, scene.materials[i], needs);
  for (const Instance& instance : scene.instances)
    if (blendsByVertex(scene, scene.meshes[static_cast<size_t>(instance.mesh)]))
      needs.transmission = needs.smoothSpecular = true;
  needs.punctualLights =
      std::any_of(scene.lights.begin(), scene.lights.end(),
                  [](const PunctualLight& light) { return !isBlack(light.intensity); });
  needs.environment = !isBlack(environment);
  return needs;
}

std::vector<std::string> describe(const Needs& needs) {
  const auto line = [](const char* what, bool on, const char* why, const char* whyNot) {
    return std::string(what) + (on ? ": on, " : ": off, ") + (on ? why : whyNot);
  };
  return {
      line("reflection layer", needs.reflection, "some surfaces reflect",
           "no surface reflects other than diffusely"),
      line("transmission layer", needs.transmission, "light passes through some surfaces",
           "no surface lets light through"),
      line("caustic photons", needs.caustics, "some surfaces can focus light",
           "no surface can focus light"),
      line("lights sampled at glossy surfaces", needs.roughSpecular, "some are not smooth",
           "none is there"),
      line("textures", needs.textures, "some materials have them", "no material has one"),
      line("alpha masks", needs.alphaMask, "some textures cut holes", "no texture cuts a hole"),
      line("area lights", needs.areaLights, "some surfaces emit", "no surface emits"),
      line("punctual lights", needs.punctualLights, "the file has some", "the file has none"),
      line("environment", needs.environment, "light comes from outside", "outside is black"),
  };
}

}  // namespace ninefold
