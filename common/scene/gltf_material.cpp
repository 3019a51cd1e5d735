#include "common/scene/gltf_material.h"

#include "common/base/log.h"
#include "common/scene/gltf_accessor.h"
#include "common/scene/gltf_value.h"
#include "common/scene/material_check.h"

namespace ninefold {
namespace {

Vec3 colour(const std::vector<double>& v, Vec3 otherwise) {
  if (v.size() < 3) return otherwise;
  return Vec3(static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]));
}

Wrap wrapOf(int mode) {
  switch (mode) {
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
      return Wrap::clamp;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
      return Wrap::mirror;
    default:
      return Wrap::repeat;
  }
}

std::string nameOf(const tinygltf::Image& image) {
  return image.name.empty() ? image.uri : image.name;
}

AlphaMode alphaModeOf(const std::string& name) {
  if (name == "MASK") return AlphaMode::mask;
  return name == "BLEND" ? AlphaMode::blend : AlphaMode::opaque;
}

// ", only 'x.ktx2' of KHR_texture_basisu" for a texture that has other images.
std::string othersOf(const tinygltf::Model& model, const tinygltf::Texture& texture) {
  std::string others;
  for (const auto& [name, value] : texture.extensions) {
    const int source = value.IsObject() ? integerOr(value, "source", -1) : -1;
    const bool isThere = source >= 0 && static_cast<size_t>(source) < model.images.size();
    const std::string image = isThere ? nameOf(model.images[static_cast<size_t>(source)]) : "";
    others += (others.empty() ? ", only " : ", ") + (image.empty() ? "that" : "'" + image + "'") +
              " of " + name;
  }
  return others;
}

float numberIn(const tinygltf::Value& object, const char* key, float otherwise) {
  return static_cast<float>(numberOr(object, key, static_cast<double>(otherwise)));
}

}  // namespace

int GltfMaterials::use(int material) {
  if (const auto known = known_.find(material); known != known_.end()) return known->second;
  scene_->materials.push_back(read(material));
  return known_[material] = static_cast<int>(scene_->materials.size()) - 1;
}

Material GltfMaterials::read(int index) {
  Material m;
  m.name = "default";
  if (index < 0) return m;
  if (static_cast<size_t>(index) >= model_->materials.size())
    fail("material {} does not exist", index);
  const tinygltf::Material& from = model_->materials[static_cast<size_t>(index)];
  try {
    readCore(from, m);
    readExtensions(from, m);
    clampFactors(m, "material " + std::to_string(index) + " '" + from.name + "'");
  } catch (const Error& e) {
    fail("material {} '{}': {}", index, from.name, e.what());
  }
  return m;
}

void GltfMaterials::readCore(const tinygltf::Material& from, Material& m) {
  const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
  m.name = from.name;
  m.baseColor = colour(pbr.baseColorFactor, Vec3(1));
  if (pbr.baseColorFactor.size() > 3) m.opacity = static_cast<float>(pbr.baseColorFactor[3]);
  m.baseColorMap = texture(pbr.baseColorTexture, true);
  m.alphaMode = alphaModeOf(from.alphaMode);
  m.alphaCutoff = static_cast<float>(from.alphaCutoff);
  m.metallic = static_cast<float>(pbr.metallicFactor);
  m.roughness = static_cast<float>(pbr.roughnessFactor);
  m.metallicRoughnessMap = texture(pbr.metallicRoughnessTexture, false);
  m.normalMap = texture(from.normalTexture, false);
  m.normalScale = static_cast<float>(from.normalTexture.scale);
  m.emission = colour(from.emissiveFactor, Vec3(0));
  m.emissionMap = texture(from.emissiveTexture, true);
  m.doubleSided = from.doubleSided;
}

void GltfMaterials::readExtensions(const tinygltf::Material& from, Material& m) {
  if (const auto* e = extensionOf(from, "KHR_materials_emissive_strength"))
    m.emission *= numberIn(*e, "emissiveStrength", 1);
  if (const auto* e = extensionOf(from, "KHR_materials_transmission")) {
    m.transmission = numberIn(*e, "transmissionFactor", 0);
    m.transmissionMap = texture(*e, "transmissionTexture", false);
  }
  if (const auto* e = extensionOf(from, "KHR_materials_volume")) {
    m.solid = numberOr(*e, "thicknessFactor", 0) > 0;
    m.attenuationColor = vectorOr(*e, "attenuationColor", Vec3(1));
    m.attenuationDistance = numberIn(*e, "attenuationDistance", m.attenuationDistance);
  }
  if (const auto* e = extensionOf(from, "KHR_materials_ior")) {
    constexpr float kFullReflection = 1e4f;  // what the extension means by an index of 0
    m.ior = numberIn(*e, "ior", 1.5f);
    if (m.ior == 0) m.ior = kFullReflection;
  }
  if (const auto* e = extensionOf(from, "KHR_materials_specular")) {
    m.specular = numberIn(*e, "specularFactor", 1);
    m.specularMap = texture(*e, "specularTexture", false);
    m.specularColor = vectorOr(*e, "specularColorFactor", Vec3(1));
    m.specularColorMap = texture(*e, "specularColorTexture", true);
  }
  readLayers(from, m);
}

void GltfMaterials::readLayers(const tinygltf::Material& from, Material& m) {
  if (const auto* e = extensionOf(from, "KHR_materials_sheen")) {
    m.sheenColor = vectorOr(*e, "sheenColorFactor", Vec3(0));
    m.sheenColorMap = texture(*e, "sheenColorTexture", true);
    m.sheenRoughness = numberIn(*e, "sheenRoughnessFactor", 0);
    m.sheenRoughnessMap = texture(*e, "sheenRoughnessTexture", false);
  }
  if (const auto* e = extensionOf(from, "KHR_materials_clearcoat")) {
    m.coat = numberIn(*e, "clearcoatFactor", 0);
    m.coatMap = texture(*e, "clearcoatTexture", false);
    m.coatRoughness = numberIn(*e, "clearcoatRoughnessFactor", 0);
    m.coatRoughnessMap = texture(*e, "clearcoatRoughnessTexture", false);
    if (m.coat > 0 && m.normalMap && !e->Has("clearcoatNormalTexture"))
      warn("material '{}': its coat follows the bumps below it; glTF means a smooth one",
           from.name);
  }
  warnOfLostLayers(m);
}

template <typename Info>
TextureUse GltfMaterials::texture(const Info& info, bool srgb) {
  if (info.index < 0) return {};
  return makeUse(info.index, info.texCoord, extensionOf(info, "KHR_texture_transform"), srgb);
}

TextureUse GltfMaterials::texture(const tinygltf::Value& extension, const char* key, bool srgb) {
  if (!extension.Has(key)) return {};
  const tinygltf::Value& info = extension.Get(key);
  const int index = integerOr(info, "index", -1);
  if (index < 0) fail("'{}' names no texture", key);
  const tinygltf::Value* transform = nullptr;
  if (info.Has("extensions") && info.Get("extensions").Has("KHR_texture_transform"))
    transform = &info.Get("extensions").Get("KHR_texture_transform");
  return makeUse(index, integerOr(info, "texCoord", 0), transform, srgb);
}

TextureUse GltfMaterials::makeUse(int texture, int uvSet, const tinygltf::Value* transform,
                                  bool srgb) {
  TextureUse use;
  use.image = image(texture, srgb);
  readSampler(texture, use);
  use.uvSet = uvSet;
  if (transform != nullptr) {
    use.offset = vectorOr(*transform, "offset", Vec2(0));
    use.scale = vectorOr(*transform, "scale", Vec2(1));
    use.rotation = numberIn(*transform, "rotation", 0);
    use.uvSet = integerOr(*transform, "texCoord", uvSet);
  }
  if (use.uvSet < 0 || use.uvSet > 1)
    fail("texture {} uses TEXCOORD_{}, only sets 0 and 1 are supported", texture, use.uvSet);
  return use;
}

void GltfMaterials::readSampler(int texture, TextureUse& use) const {
  const int index = model_->textures[static_cast<size_t>(texture)].sampler;
  if (index < 0) return;
  if (static_cast<size_t>(index) >= model_->samplers.size())
    fail("sampler {} of texture {} does not exist", index, texture);
  const tinygltf::Sampler& sampler = model_->samplers[static_cast<size_t>(index)];
  use.wrapS = wrapOf(sampler.wrapS), use.wrapT = wrapOf(sampler.wrapT);
  use.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
}

int GltfMaterials::image(int texture, bool srgb) {
  if (static_cast<size_t>(texture) >= model_->textures.size())
    fail("texture {} does not exist", texture);
  const int source = model_->textures[static_cast<size_t>(texture)].source;
  if (source < 0 || static_cast<size_t>(source) >= model_->images.size())
    fail("texture {} names no PNG or JPEG image{}: export it as one of them", texture,
         othersOf(*model_, model_->textures[static_cast<size_t>(texture)]));
  const tinygltf::Image& from = model_->images[static_cast<size_t>(source)];
  const std::string name = "image " + std::to_string(source) + " '" + nameOf(from) + "'";
  const auto bytes = [&]() -> std::span<const unsigned char> {
    if (const auto bad = badImages_->find(source); bad != badImages_->end())
      fail("{}", bad->second);
    if (from.bufferView < 0) return from.image;
    const BytesOfView view = bytesOfView(*model_, from.bufferView, name);
    return {view.data, view.size};
  };
  return images_.add({name, bytes}, srgb);
}

}  // namespace ninefold
