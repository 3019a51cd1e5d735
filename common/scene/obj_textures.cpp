#include "common/scene/obj_textures.h"

#include <algorithm>
#include <array>
#include <vector>

#include "common/base/error.h"
#include "common/base/log.h"

namespace ninefold {
namespace {

constexpr uint64_t kMaxImageBytes = 1 << 30;

// A texture of the scene's folder. Keeps the file's bytes while they are decoded.
struct FileImage : ImageSource {
  FileImage(const SceneFolder& folder, const std::string& beside, const MtlMap& map) {
    const std::string file = findFile(folder, beside, map.file).value_or(map.file);
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

// v points up in the file: 1 - v' = 1 - (s v + o) = s (1 - v) + 1 - s - o.
TextureUse useOf(int image, const MtlMap& map) {
  TextureUse use;
  use.image = image;
  use.scale = map.scale;
  use.offset = Vec2(map.offset.x, 1 - map.scale.y - map.offset.y);
  if (map.clamp) use.wrapS = use.wrapT = Wrap::clamp;
  return use;
}

Gain gainOf(const MtlMap& map) { return {map.base, map.gain}; }

// What the texels of a map are made with, for the name of the image.
std::string nameOf(const MtlMap& map, Gain gain) {
  std::string name = "'" + map.file + "'";
  if (map.channel != 0) name += fmt::format(" channel {}", map.channel);
  if (!gain.isIdentity()) name += fmt::format(" as {} + {} t", gain.base, gain.gain);
  return name;
}

bool sameCoordinates(const MtlMap& a, const MtlMap& b) {
  return a.scale == b.scale && a.offset == b.offset && a.clamp == b.clamp;
}

void warnIfApart(const MtlMaterial& from, const MtlMap& a, const MtlMap& b, const char* names) {
  if (a && b && !sameCoordinates(a, b))
    warn("material '{}': {} have different -s, -o or -clamp: the second has those of the first",
         from.name, names);
}

// A gain that never leaves [0, limit] is a factor; another goes into the texels, times a factor
// that brings their largest to 1.
struct SplitGain {
  float factor;
  Gain texels;
};
SplitGain split(Gain gain, float limit) {
  if (gain.base == 0 && gain.gain >= 0 && gain.gain <= limit) return {gain.gain, {}};
  const float largest = std::max(gain.base, gain.base + gain.gain);
  const float factor = std::clamp(largest, 0.0f, limit);
  if (factor <= 0) return {0, {}};
  return {factor, {gain.base / factor, gain.gain / factor}};
}

}  // namespace

std::optional<std::string> findFile(const SceneFolder& folder, const std::string& beside,
                                    const std::string& name) {
  const std::string bare = name.substr(name.rfind('/') + 1);
  const auto first = [&](const auto& find) -> std::optional<std::string> {
    for (const std::string& path : {beside + name, name, beside + bare, bare}) try {
        if (std::string file = find(path); !file.empty()) return file;
      } catch (const Error&) {  // leads elsewhere: the next may not
      }
    return {};
  };
  const auto exact = first([&](const auto& p) { return folder.exists(p) ? p : std::string(); });
  return exact ? exact : first([&](const auto& p) { return folder.spelled(p); });
}

void ObjTextures::addMaps(const MtlMaterial& from, const std::string& beside, Material& m) {
  beside_ = beside;
  if (from.mapKd || from.mapD) addColour(from, m);
  if (from.mapKe) addEmission(from.mapKe, m);
  if (from.mapKs) addSpecular(from.mapKs, m);
  if (from.mapPr || from.mapPm) addMetallicRoughness(from, m);
  if (from.norm || from.bump) addNormals(from, m);
}

int ObjTextures::colours(const MtlMap& map, Gain gain) {
  const FileImage source(*folder_, beside_, map);
  if (gain.isIdentity() && map.channel == 0) return images_.add(source, true);
  const std::array<const ImageSource*, 1> parts = {&source};
  return images_.addMade(source.name + nameOf(map, gain), true, parts,
                         [&](auto decoded) { return coloursOf(decoded[0], map.channel, gain); });
}

void ObjTextures::addColour(const MtlMaterial& from, Material& m) {
  const MtlMap &colour = from.mapKd, &cover = from.mapD;
  const SplitGain gain = split(gainOf(colour), 1);
  if (colour) m.baseColor *= gain.factor;
  if (!cover && m.alphaMode == AlphaMode::opaque) {
    m.baseColorMap = useOf(colours(colour, gain.texels), colour);
    return;
  }
  warnIfApart(from, colour, cover, "map_Kd and map_d");
  const FileImage colourFile(*folder_, beside_, colour), coverFile(*folder_, beside_, cover);
  std::vector<const ImageSource*> parts;
  if (colour) parts.push_back(&colourFile);
  if (cover) parts.push_back(&coverFile);
  const std::string name = (colour ? colourFile.name + nameOf(colour, gain.texels) : "white") +
                           (cover ? " covered by " + coverFile.name + nameOf(cover, gainOf(cover))
                                  : " without its alpha");
  const int image = images_.addMade(name, true, parts, [&](auto decoded) {
    TextureImage white;
    white.width = white.height = 1, white.texels.assign(4, 255);
    const TextureImage colours =
        colour ? coloursOf(decoded[0], colour.channel, gain.texels) : white;
    if (!cover) return colours;
    const TextureImage& mask = decoded.back();
    const char channel = cover.channel != 0 ? cover.channel : coverageChannel(mask);
    return coveredBy(colours, scalarOf(mask, channel, gainOf(cover)));
  });
  m.baseColorMap = useOf(image, colour ? colour : cover);
  m.alphaMode = AlphaMode::blend;
}

void ObjTextures::addEmission(const MtlMap& map, Material& m) {
  constexpr float kAny = 1e12f;
  const SplitGain gain = split(gainOf(map), kAny);
  m.emission *= gain.factor;
  m.emissionMap = useOf(colours(map, gain.texels), map);
}

void ObjTextures::addSpecular(const MtlMap& map, Material& m) {
  const SplitGain gain = split(gainOf(map), 1);
  m.specularColor *= gain.factor;
  m.specularColorMap = useOf(colours(map, gain.texels), map);
}

void ObjTextures::addMetallicRoughness(const MtlMaterial& from, Material& m) {
  const MtlMap &rough = from.mapPr, &metal = from.mapPm;
  warnIfApart(from, rough, metal, "map_Pr and map_Pm");
  const FileImage roughFile(*folder_, beside_, rough), metalFile(*folder_, beside_, metal);
  std::vector<const ImageSource*> parts;
  std::string name;
  if (rough) parts.push_back(&roughFile), name += "roughness " + nameOf(rough, gainOf(rough));
  if (metal) parts.push_back(&metalFile), name += "metallic " + nameOf(metal, gainOf(metal));
  const int image = images_.addMade(beside_ + name, false, parts, [&](auto decoded) {
    std::optional<TextureImage> roughness, metallic;
    if (rough) roughness = scalarOf(decoded[0], rough.channel, gainOf(rough));
    if (metal) metallic = scalarOf(decoded.back(), metal.channel, gainOf(metal));
    return metallicRoughness(roughness ? &*roughness : nullptr, metallic ? &*metallic : nullptr);
  });
  m.metallicRoughnessMap = useOf(image, rough ? rough : metal);
}

void ObjTextures::addNormals(const MtlMaterial& from, Material& m) {
  if (from.norm) {
    if (from.bump) warn("material '{}': it has norm and bump: bump is left out", from.name);
    const FileImage normals(*folder_, beside_, from.norm);
    m.normalMap = useOf(images_.add(normals, false), from.norm);
    m.normalScale = from.norm.bump;
    return;
  }
  const MtlMap& map = from.bump;
  const FileImage source(*folder_, beside_, map);
  const std::array<const ImageSource*, 1> parts = {&source};
  const std::string name =
      fmt::format("{} as bumps {} times {}", source.name, nameOf(map, gainOf(map)), map.bump);
  const int image = images_.addMade(name, false, parts, [&](auto decoded) {
    if (isNormalMap(decoded[0])) return scaledNormals(decoded[0], map.bump);
    return normalsOfHeights(scalarOf(decoded[0], map.channel, gainOf(map)), map.bump,
                            map.clamp ? Wrap::clamp : Wrap::repeat);
  });
  m.normalMap = useOf(image, map);
}

}  // namespace ninefold
