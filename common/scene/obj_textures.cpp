#include "common/scene/obj_textures.h"

#include <algorithm>
#include <array>
#include <vector>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/scene/file_search.h"
#include "common/scene/shared_coordinates.h"

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

Gain gainOf(const MtlMap& map) { return {map.base, map.gain}; }

// The name of an image: its file and what its texels are made with.
std::string nameOf(const ImageSource& source, const MtlMap& map, Gain gain) {
  std::string name = source.name;
  if (map.channel != 0) name += fmt::format(" channel {}", map.channel);
  if (!gain.isIdentity()) name += fmt::format(" as {} + {} t", gain.base, gain.gain);
  return name;
}
std::string nameOf(const ImageSource& source, const MtlMap& map, Gain gain,
                   const SharedCoordinates& shared) {
  return nameOf(source, map, gain) + shared.nameOf(map);
}

TextureImage white() {
  TextureImage image;
  image.width = image.height = 1;
  image.texels.assign(4, 255);
  return image;
}

// A gain that never leaves [0, limit] is a factor. Any other goes into the texels, times a factor
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
  return images_.addMade(nameOf(source, map, gain), true, parts,
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
  const SharedCoordinates shared(from, colour, cover, "map_Kd and map_d");
  const FileImage colourFile(*folder_, beside_, colour), coverFile(*folder_, beside_, cover);
  std::vector<const ImageSource*> parts;
  std::string name = "white";
  if (colour) parts.push_back(&colourFile), name = nameOf(colourFile, colour, gain.texels, shared);
  if (cover) parts.push_back(&coverFile);
  name += cover ? " covered by " + nameOf(coverFile, cover, gainOf(cover), shared)
                : " without its alpha";
  const int image = images_.addMade(name, true, parts, [&](auto decoded) {
    TextureImage colours = white();
    if (colour) colours = shared.place(coloursOf(decoded[0], colour.channel, gain.texels), colour);
    if (!cover) return colours;
    const TextureImage& mask = decoded.back();
    const char channel = cover.channel != 0 ? cover.channel : coverageChannel(mask);
    return coveredBy(colours, shared.place(scalarOf(mask, channel, gainOf(cover)), cover));
  });
  m.baseColorMap = shared.use(image);
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
  const SharedCoordinates shared(from, rough, metal, "map_Pr and map_Pm");
  const FileImage roughFile(*folder_, beside_, rough), metalFile(*folder_, beside_, metal);
  std::vector<const ImageSource*> parts;
  std::string name;
  if (rough)
    parts.push_back(&roughFile),
        name += " roughness " + nameOf(roughFile, rough, gainOf(rough), shared);
  if (metal)
    parts.push_back(&metalFile),
        name += " metallic " + nameOf(metalFile, metal, gainOf(metal), shared);
  const int image = images_.addMade(name, false, parts, [&](auto decoded) {
    const auto scalar = [&](const TextureImage& part, const MtlMap& map) {
      return shared.place(scalarOf(part, map.channel, gainOf(map)), map);
    };
    std::optional<TextureImage> roughness, metallic;
    if (rough) roughness = scalar(decoded[0], rough);
    if (metal) metallic = scalar(decoded.back(), metal);
    return metallicRoughness(roughness ? &*roughness : nullptr, metallic ? &*metallic : nullptr);
  });
  m.metallicRoughnessMap = shared.use(image);
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
  const float strength = std::clamp(map.bump, -1e4f, 1e4f);
  const std::string name = fmt::format("{} as bumps times {}{}", nameOf(source, map, gainOf(map)),
                                       strength, map.clamp ? " with edges" : "");
  const int image = images_.addMade(name, false, parts, [&](auto decoded) {
    if (isNormalMap(decoded[0])) return scaledNormals(decoded[0], strength);
    return normalsOfHeights(scalarOf(decoded[0], map.channel, gainOf(map)), strength,
                            map.clamp ? Wrap::clamp : Wrap::repeat);
  });
  m.normalMap = useOf(image, map);
}

}  // namespace ninefold
