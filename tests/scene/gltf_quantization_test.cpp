// KHR_mesh_quantization: integers of every allowed type and both meanings, for each attribute.
// An integer c of b bits that is normalized stands for c / (2^b - 1) if unsigned, else for
// max(c / (2^(b-1) - 1), -1).
#include <gtest/gtest.h>

#include <limits>

#include "common/scene/reader.h"
#include "tests/scene/gltf_bytes.h"
#include "tests/scene/png_bytes.h"
#include "tests/scene/temp_folder.h"

namespace ninefold {
namespace {

constexpr int kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123;

// A triangle with one more attribute, or another POSITION: rows of four numbers, the last one is
// padding where the type has three.
struct Attribute {
  std::string name, type = "VEC3";
  int component = 0;
  bool normalized = false;
};

template <typename T>
Mesh read(const Attribute& attribute, const std::vector<T>& rows,
          const std::string& material = R"({"name": "paint"})", Scene* whole = nullptr) {
  Bytes bytes = triangleBytes();
  append(bytes, rows);
  std::string json = with(kTriangleJson, R"({"name": "paint"})", material);
  const std::string normals = attribute.name == "TANGENT" ? R"(, "NORMAL": 0)" : "";
  json = attribute.name == "POSITION"
             ? with(json, R"("POSITION": 0)", R"("POSITION": 2)")
             : with(json, R"("POSITION": 0)",
                    R"("POSITION": 0, ")" + attribute.name + R"(": 2)" + normals);
  json = with(json, R"("type": "SCALAR"})",
              R"("type": "SCALAR"}, {"bufferView": 2, "count": 3, "type": ")" + attribute.type +
                  R"(", "componentType": )" + std::to_string(attribute.component) +
                  (attribute.normalized ? R"(, "normalized": true})" : "}"));
  const size_t stride = 4 * sizeof(T);
  json =
      with(json, R"("byteOffset": 36, "byteLength": 12})",
           R"("byteOffset": 36, "byteLength": 12}, {"buffer": 0, "byteOffset": 48,
                 "byteLength": )" +
               std::to_string(3 * stride) + R"(, "byteStride": )" + std::to_string(stride) + "}");
  json = with(json, R"("byteLength": 48})",
              R"("byteLength": )" + std::to_string(48 + 3 * stride) + "}");
  json =
      with(json, R"("scene": 0)", R"("extensionsRequired": ["KHR_mesh_quantization"], "scene": 0)");
  const TempFolder folder;
  folder.write("pixel.png", png(1, 1, 3, {9, 99, 199}));
  const Scene scene = readScene(folder.write("scene.glb", glb(json, bytes)));
  if (whole != nullptr) *whole = scene;
  return scene.meshes[0];
}

template <typename T>
void expectPositions(int component) {
  constexpr T most = std::numeric_limits<T>::max(), least = std::numeric_limits<T>::min();
  const std::vector<T> rows = {0, 0, 0, 99, most, 0, 0, 99, 1, least, most, 99};
  const Mesh whole = read(Attribute{"POSITION", "VEC3", component, false}, rows);
  EXPECT_EQ(whole.positions[1], Vec3(most, 0, 0)) << component;
  EXPECT_EQ(whole.positions[2], Vec3(1, least, most)) << component;
  const Mesh fraction = read(Attribute{"POSITION", "VEC3", component, true}, rows);
  EXPECT_EQ(fraction.positions[1], Vec3(1, 0, 0)) << component;
  EXPECT_EQ(fraction.positions[2], Vec3(1 / static_cast<float>(most), least < 0 ? -1 : 0, 1))
      << component;
}

TEST(GltfQuantization, PositionsOfAllTypesAndBothMeanings) {
  expectPositions<int8_t>(kByte);
  expectPositions<uint8_t>(kUnsignedByte);
  expectPositions<int16_t>(kShort);
  expectPositions<uint16_t>(kUnsignedShort);
}

TEST(GltfQuantization, NormalsAndTangentsBecomeUnit) {
  const Mesh bytes =
      read<int8_t>({"NORMAL", "VEC3", kByte, true}, {0, 0, 127, 0, 76, 0, 101, 0, 0, -90, 90, 0});
  EXPECT_NEAR(glm::length(bytes.normals[1] - Vec3(0.6f, 0, 0.8f)), 0, 0.005);
  EXPECT_NEAR(glm::length(bytes.normals[2] - Vec3(0, -std::sqrt(0.5f), std::sqrt(0.5f))), 0, 1e-6);
  const Mesh shorts = read<int16_t>({"TANGENT", "VEC4", kShort, true},
                                    {32767, 0, 0, 32767, 0, 32767, 0, -32767, 32767, 0, 0, 32767});
  ASSERT_EQ(shorts.tangents.size(), 3u);
  EXPECT_EQ(shorts.tangents[1], Vec4(0, 1, 0, -1));
}

template <typename T>
void expectCoordinates(int component) {
  constexpr T most = std::numeric_limits<T>::max();
  const std::vector<T> rows = {0, 0, 0, 0, most, 1, 0, 0, 2, most, 0, 0};
  const Mesh whole = read(Attribute{"TEXCOORD_0", "VEC2", component, false}, rows);
  EXPECT_EQ(whole.uv0[1], Vec2(most, 1)) << component;
  const Mesh fraction = read(Attribute{"TEXCOORD_0", "VEC2", component, true}, rows);
  EXPECT_EQ(fraction.uv0[2], Vec2(2 / static_cast<float>(most), 1)) << component;
}

TEST(GltfQuantization, TextureCoordinatesOfAllTypesAndBothMeanings) {
  expectCoordinates<int8_t>(kByte);
  expectCoordinates<uint8_t>(kUnsignedByte);
  expectCoordinates<int16_t>(kShort);
  expectCoordinates<uint16_t>(kUnsignedShort);
}

// Tools store coordinates as whole numbers, and undo it by the texture's transform.
TEST(GltfQuantization, TheTexturesTransformScalesWholeNumbersBack) {
  Scene scene;
  const Mesh mesh = read<uint16_t>(
      {"TEXCOORD_0", "VEC2", kUnsignedShort, false}, {0, 0, 0, 0, 4095, 0, 0, 0, 0, 4095, 0, 0},
      R"({"name": "paint", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "extensions":
         {"KHR_texture_transform": {"offset": [0.25, 0.5], "scale": [0.000244200244, 0.000122100122]
         }}}}}], "textures": [{"source": 0}], "images": [{"uri": "pixel.png"})",
      &scene);
  const TextureUse& use = scene.materials[0].baseColorMap;
  const Vec2 u = use.offset + use.scale * mesh.uv0[1], v = use.offset + use.scale * mesh.uv0[2];
  EXPECT_NEAR(u.x, 1.25, 1e-6);
  EXPECT_NEAR(v.y, 1.0, 1e-6);
}

}  // namespace
}  // namespace ninefold
