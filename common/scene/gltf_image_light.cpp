#include "common/scene/gltf_image_light.h"

#include <array>

#include "common/base/log.h"
#include "common/image/decode.h"
#include "common/scene/gltf_accessor.h"
#include "common/scene/gltf_value.h"
#include "common/scene/reader.h"
#include "common/scene/texture.h"

namespace ninefold {
namespace {

constexpr const char* kName = "EXT_lights_image_based";
constexpr int kFaces = 6;
constexpr int kFine = 2;
constexpr uint64_t kWidestFace = 4096;

using Cube = std::array<TextureImage, kFaces>;

// The member of an object; nothing that is no object of its kind has any.
const tinygltf::Value& memberOf(const tinygltf::Value& object, const char* key) {
  if (!object.IsObject() || !object.Has(key)) fail("it has no '{}'", key);
  return object.Get(key);
}

const tinygltf::Value& elementOf(const tinygltf::Value& list, size_t i, const char* what) {
  if (!list.IsArray() || i >= list.ArrayLen()) fail("{} {} does not exist", what, i);
  return list.Get(static_cast<int>(i));
}

TextureImage readFace(const GltfFile& file, int index) {
  const tinygltf::Model& model = *file.model;
  if (index < 0 || static_cast<size_t>(index) >= model.images.size())
    fail("image {} does not exist", index);
  const tinygltf::Image& from = model.images[static_cast<size_t>(index)];
  if (const auto bad = file.badImages.find(index); bad != file.badImages.end())
    fail("{}", bad->second);
  std::span<const unsigned char> bytes = from.image;
  if (from.bufferView >= 0) {
    const BytesOfView view = bytesOfView(model, from.bufferView, "an image");
    bytes = {view.data, view.size};
  }
  DecodedImage decoded =
      decodeImage(std::as_bytes(bytes), {kWidestFace, kWidestFace * kWidestFace});
  if (decoded.width != decoded.height)
    fail("image {} is {} x {}, a face of a cube is square", index, decoded.width, decoded.height);
  TextureImage face;
  face.width = decoded.width, face.height = decoded.height, face.channels = decoded.channels;
  face.srgb = true, face.texels = std::move(decoded.texels);
  return face;
}

Cube readCube(const GltfFile& file, const tinygltf::Value& light) {
  const tinygltf::Value& sharpest =
      elementOf(memberOf(light, "specularImages"), 0, "list of specularImages");
  Cube cube;
  for (size_t i = 0; i < kFaces; ++i) {
    const tinygltf::Value& index = elementOf(sharpest, i, "face");
    if (!index.IsInt()) fail("face {} names no image", i);
    cube[i] = readFace(file, index.GetNumberAsInt());
    if (cube[i].width != cube[0].width)
      fail("its faces are {} and {} texels wide", cube[0].width, cube[i].width);
  }
  return cube;
}

Vec3 radianceOf(const TextureImage& face, int x, int y) {
  const Vec4 texel =
      texelOf(face, std::clamp(x, 0, face.width - 1), std::clamp(y, 0, face.width - 1));
  constexpr float kLeastShare = 1.0f / 255;
  return face.channels == 4 ? Vec3(texel) / std::max(texel.w, kLeastShare) : Vec3(texel);
}

// Bilinear at (s, t), each 0 to 1 across the face, from its upper left corner. At its edges the
// outermost texels go on.
Vec3 at(const TextureImage& face, float s, float t) {
  const auto size = static_cast<float>(face.width);
  const float x = s * size - 0.5f, y = t * size - 0.5f;
  const float left = std::floor(x), top = std::floor(y);
  const auto i = static_cast<int>(left), j = static_cast<int>(top);
  const auto row = [&](int line) {
    const Vec3 a = radianceOf(face, i, line), b = radianceOf(face, i + 1, line);
    return a + (x - left) * (b - a);
  };
  const Vec3 upper = row(j);
  return upper + (y - top) * (row(j + 1) - upper);
}

// Towards w, in the cube's own axes. Each face spans -1 to 1 of (across, down) where the third axis
// is 1.
Vec3 towards(const Cube& cube, Vec3 w) {
  const Vec3 size = glm::abs(w);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const float sign = w[axis] < 0 ? -1.0f : 1.0f;
  const Vec3 p = w / size[axis];
  const float across = axis == 0 ? sign * p.z : axis == 1 ? -p.x : -sign * p.x;
  const float down = axis == 1 ? sign * p.z : -p.y;
  const auto face = static_cast<size_t>(2 * axis + (sign < 0 ? 1 : 0));
  return at(cube[face], 0.5f * (across + 1), 0.5f * (down + 1));
}

// From world to the cube: the inverse of a quaternion's turn.
DMat3 unturned(const tinygltf::Value& light) {
  const Vec4 q = vectorOr(light, "rotation", Vec4(0, 0, 0, 1));
  const double length = glm::length(DVec4(q));
  if (!(length > 1e-6) || !std::isfinite(length)) fail("its rotation is no quaternion");
  const DVec4 u = DVec4(q) / length;
  const DVec3 v(u);
  const auto turn = [&](DVec3 p) { return p + 2.0 * glm::cross(v, glm::cross(v, p) + u.w * p); };
  return glm::transpose(DMat3(turn({1, 0, 0}), turn({0, 1, 0}), turn({0, 0, 1})));
}

EnvironmentPicture pictureOf(const Cube& cube, const DMat3& toCube) {
  EnvironmentPicture picture;
  picture.width = std::clamp(4 * cube[0].width, 2, kWidestEnvironment);
  picture.height = picture.width / 2;
  const int columns = kFine * picture.width, rows = kFine * picture.height;
  const auto direction = [&](int column, int row) {
    const double theta = (row + 0.5) * double{kPi} / rows;
    const double phi = (column + 0.5) * 2 * double{kPi} / columns - double{kPi};
    return toCube *
           DVec3(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
  };
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      Vec3 sum(0);
      for (int k = 0; k < kFine * kFine; ++k)
        sum += towards(cube, Vec3(direction(kFine * x + k % kFine, kFine * y + k / kFine)));
      picture.texels.push_back(sum / float{kFine * kFine});
    }
  return picture;
}

}  // namespace

ImageLight readImageLight(const GltfFile& file) {
  const tinygltf::Model& model = *file.model;
  const auto scene = static_cast<size_t>(std::max(model.defaultScene, 0));
  const auto all = model.extensions.find(kName);
  if (scene >= model.scenes.size() || all == model.extensions.end()) return {};
  const tinygltf::Value* use = extensionOf(model.scenes[scene], kName);
  if (use == nullptr) return {};
  const int index = integerOr(*use, "light", -1);
  try {
    const tinygltf::Value& light =
        elementOf(memberOf(all->second, "lights"), static_cast<size_t>(index), "light");
    const auto intensity = static_cast<float>(numberOr(light, "intensity", 1));
    if (!(intensity >= 0 && intensity <= kBrightestTexel)) fail("its intensity is {}", intensity);
    const DMat3 toCube = unturned(light);
    return {std::make_shared<const EnvironmentMap>(pictureOf(readCube(file, light), toCube)),
            intensity};
  } catch (const Error& error) {
    warn(
        "{} {}: {}; its light from outside is missing: give a picture with --environment FILE.hdr "
        "or .exr",
        kName, index, error.what());
    return {};
  }
}

}  // namespace ninefold
