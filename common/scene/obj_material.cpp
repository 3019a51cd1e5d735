#include "common/scene/obj_material.h"

#include <tiny_obj_loader.h>

#include <limits>
#include <sstream>

#include "common/base/error.h"
#include "common/base/log.h"

namespace ninefold {
namespace {

constexpr uint64_t kMaxLibraryBytes = 64 << 20;
constexpr uint64_t kMaxImageBytes = 1 << 30;
constexpr float kDefaultGrey = 0.6f;

// Not-a-number becomes 0.
float clamped(float v, float high) { return v > 0 ? std::min(v, high) : 0.0f; }

Vec3 colour(const float (&from)[3], float high = 1) {
  return Vec3(clamped(from[0], high), clamped(from[1], high), clamped(from[2], high));
}

bool isGlass(const tinyobj::material_t& from) {
  return from.illum == 4 || from.illum == 6 || from.illum == 7 || from.illum == 9;
}

bool isMirror(const tinyobj::material_t& from) {
  return (from.illum == 3 || from.illum == 5) &&
         maxComponent(colour(from.specular)) > maxComponent(colour(from.diffuse));
}

void makeGlass(const tinyobj::material_t& from, Material& m) {
  constexpr float kLargestIndex = 100;
  const Vec3 tint = colour(from.transmittance, std::numeric_limits<float>::max());
  m.baseColor = isBlack(tint) ? Vec3(1) : tint / maxComponent(tint);
  m.roughness = 0;
  m.transmission = 1;
  m.solid = true;
  m.ior = from.ior > 1 ? std::min(from.ior, kLargestIndex) : 1.5f;
}

void makeMirror(const tinyobj::material_t& from, Material& m) {
  m.baseColor = colour(from.specular);
  m.metallic = 1, m.roughness = 0;
}

void makePlain(const tinyobj::material_t& from, Material& m) {
  const Vec3 Ks = colour(from.specular);
  const float Ns = clamped(from.shininess, 1e6f);
  m.baseColor = colour(from.diffuse);
  m.ior = from.ior > 1 ? std::min(from.ior, 3.0f) : 1.5f;
  m.specular = std::min(1.0f, 2 * maxComponent(Ks));
  m.specularColor = isBlack(Ks) ? Vec3(1) : Ks / maxComponent(Ks);
  const float alpha = std::sqrt(2 / (Ns + 2));
  m.roughness = std::sqrt(alpha);
  m.opacity = clamped(from.dissolve, 1);
  if (m.opacity < 1) m.alphaMode = AlphaMode::blend;
}

Material translated(const tinyobj::material_t& from) {
  Material m;
  m.name = from.name;
  m.metallic = 0;
  if (isGlass(from))
    makeGlass(from, m);
  else if (isMirror(from))
    makeMirror(from, m);
  else
    makePlain(from, m);
  m.emission = colour(from.emission, std::numeric_limits<float>::max());
  return m;
}

Material defaultGrey(const std::string& name) {
  Material m;
  m.name = name;
  m.baseColor = Vec3(kDefaultGrey);
  m.metallic = 0, m.specular = 0;
  return m;
}

// v points up in the file: 1 - v' = 1 - (s v + o) = s (1 - v) + 1 - s - o.
TextureUse useOf(int image, const tinyobj::texture_option_t& option) {
  TextureUse use;
  use.image = image;
  use.scale = Vec2(option.scale[0], option.scale[1]);
  use.offset = Vec2(option.origin_offset[0], 1 - option.scale[1] - option.origin_offset[1]);
  if (option.clamp) use.wrapS = use.wrapT = Wrap::clamp;
  return use;
}

// A texture of the scene's folder. Keeps the file's bytes while they are decoded.
struct FileImage : ImageSource {
  FileImage(const SceneFolder& folder, std::string file) {
    std::replace(file.begin(), file.end(), '\\', '/');
    name = "texture '" + file + "'";
    bytes = [this, &folder, file]() -> std::span<const unsigned char> {
      content = folder.read(file, kMaxImageBytes);
      return content;
    };
  }
  FileImage(const FileImage&) = delete;
  FileImage& operator=(const FileImage&) = delete;
  std::vector<unsigned char> content;
};

void addMaps(const tinyobj::material_t& from, const SceneFolder& folder, ImageLibrary& images,
             Material& m) {
  const FileImage diffuse(folder, from.diffuse_texname), mask(folder, from.alpha_texname);
  const bool hasDiffuse = !from.diffuse_texname.empty(), hasMask = !from.alpha_texname.empty();
  if (hasMask) {
    m.baseColorMap = useOf(images.addCutout(hasDiffuse ? &diffuse : nullptr, mask),
                           hasDiffuse ? from.diffuse_texopt : from.alpha_texopt);
    m.alphaMode = AlphaMode::mask;
  } else if (hasDiffuse) {
    m.baseColorMap = useOf(images.add(diffuse, true), from.diffuse_texopt);
  }
  if (hasDiffuse && isBlack(m.baseColor)) m.baseColor = Vec3(1);
  if (!from.emissive_texname.empty()) {
    const FileImage emission(folder, from.emissive_texname);
    m.emissionMap = useOf(images.add(emission, true), from.emissive_texopt);
    if (isBlack(m.emission)) m.emission = Vec3(1);
  }
  if (!from.normal_texname.empty()) {
    const FileImage normal(folder, from.normal_texname);
    m.normalMap = useOf(images.add(normal, false), from.normal_texopt);
  }
}

}  // namespace

struct ObjMaterials::Sources {
  std::map<std::string, int> byName;
  std::vector<tinyobj::material_t> materials;
};

ObjMaterials::ObjMaterials(const SceneFolder& folder, Scene& scene)
    : folder_(&folder),
      scene_(&scene),
      images_(scene.images.own()),
      sources_(std::make_shared<Sources>()) {}

// False if the folder has no such file; what leads outside of it is an error.
bool ObjMaterials::addFile(const std::string& name) {
  std::string path = name;
  std::replace(path.begin(), path.end(), '\\', '/');
  if (!folder_->exists(path)) return false;
  const std::vector<unsigned char> bytes = folder_->read(path, kMaxLibraryBytes);
  std::istringstream text(std::string(bytes.begin(), bytes.end()));
  std::string warnings, errors;
  tinyobj::LoadMtl(&sources_->byName, &sources_->materials, &text, &warnings, &errors);
  return true;
}

void ObjMaterials::addLibrary(const std::string& line) {
  if (addFile(line)) return;  // one name, which may have blanks
  std::istringstream words(line);
  for (std::string name; words >> name;)
    if (!addFile(name))
      warn(
          "material library '{}' is missing: its materials are grey; put it into the scene's "
          "folder",
          name);
}

int ObjMaterials::use(const std::string& name) {
  if (const auto known = known_.find(name); known != known_.end()) return known->second;
  const auto found = sources_->byName.find(name);
  if (found == sources_->byName.end()) {
    if (!name.empty()) warn("material '{}' is in no library: it is grey", name);
    scene_->materials.push_back(defaultGrey(name));
  } else {
    const auto& from = sources_->materials[static_cast<size_t>(found->second)];
    Material m = translated(from);
    try {
      addMaps(from, *folder_, images_, m);
    } catch (const Error& e) {
      fail("material '{}': {}", name, e.what());
    }
    scene_->materials.push_back(std::move(m));
  }
  return known_[name] = static_cast<int>(scene_->materials.size()) - 1;
}

}  // namespace ninefold
