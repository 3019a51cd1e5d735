// COLOR_0 in every form that glTF allows. Values: fractions of the type's largest; RGB is opaque.
#include <gtest/gtest.h>

#include "common/scene/gltf_writer.h"
#include "common/scene/reader.h"
#include "tests/scene/gltf_bytes.h"
#include "tests/scene/one_line_error.h"
#include "tests/scene/temp_folder.h"

namespace ninefold {
namespace {

// The triangle with the given bytes as COLOR_0; `accessor`: the rest of its accessor.
Scene colored(const Bytes& colors, const std::string& accessor, const std::string& view = "") {
  std::string json = with(kTriangleJson, R"({"POSITION": 0})", R"({"POSITION": 0, "COLOR_0": 2})");
  json = with(json, R"("type": "SCALAR"})",
              R"("type": "SCALAR"}, {"bufferView": 2, )" + accessor + "}");
  json = with(json, R"("byteLength": 12})",
              R"("byteLength": 12}, {"buffer": 0, "byteOffset": 48, "byteLength": )" +
                  std::to_string(colors.size()) + view + "}");
  json = with(json, R"([{"byteLength": 48}])",
              R"([{"byteLength": )" + std::to_string(48 + colors.size()) + "}]");
  Bytes bytes = triangleBytes();
  bytes.insert(bytes.end(), colors.begin(), colors.end());
  const TempFolder folder;
  return readScene(folder.write("scene.glb", glb(json, bytes)));
}

template <typename T>
Bytes bytesOf(const std::vector<T>& values) {
  Bytes bytes;
  append(bytes, values);
  return bytes;
}

void expectColors(const Scene& scene, const std::vector<Vec4>& expected) {
  ASSERT_EQ(scene.meshes[0].colors.size(), expected.size());
  for (size_t i = 0; i < expected.size(); ++i)
    for (int c = 0; c < 4; ++c)
      EXPECT_NEAR(scene.meshes[0].colors[i][c], expected[i][c], 1e-6f) << i;
}

TEST(GltfColor, FloatsWithAndWithoutAlpha) {
  expectColors(colored(bytesOf<float>({.8f, .2f, .1f, 1, 0, 0, 0, .5f, 0}),
                       R"("componentType": 5126, "count": 3, "type": "VEC3")"),
               {{.8f, .2f, .1f, 1}, {1, 0, 0, 1}, {0, .5f, 0, 1}});
  expectColors(colored(bytesOf<float>({.8f, .2f, .1f, .25f, 1, 0, 0, 0, 0, .5f, 0, 1}),
                       R"("componentType": 5126, "count": 3, "type": "VEC4")"),
               {{.8f, .2f, .1f, .25f}, {1, 0, 0, 0}, {0, .5f, 0, 1}});
}

TEST(GltfColor, BytesAndShortsAreFractionsOfTheirLargest) {
  const std::vector<Vec4> expected = {{1, 0, .2f, .4f}, {.6f, .8f, 1, 1}, {0, 0, 0, 0}};
  for (const char* normalized :
       {R"("normalized": true, )", ""})  // also if the file forgets to say so
    expectColors(
        colored(bytesOf<uint8_t>({255, 0, 51, 102, 153, 204, 255, 255, 0, 0, 0, 0}),
                std::string(normalized) + R"("componentType": 5121, "count": 3, "type": "VEC4")"),
        expected);
  expectColors(
      colored(bytesOf<uint16_t>({65535, 0, 13107, 26214, 39321, 52428, 65535, 65535, 0, 0, 0, 0}),
              R"("normalized": true, "componentType": 5123, "count": 3, "type": "VEC4")"),
      expected);
}

// RGB bytes are padded to four.
TEST(GltfColor, StridesAreSkipped) {
  expectColors(colored(bytesOf<uint8_t>({255, 0, 0, 9, 0, 255, 0, 9, 0, 0, 255, 9}),
                       R"("normalized": true, "componentType": 5121, "count": 3, "type": "VEC3")",
                       R"(, "byteStride": 4)"),
               {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}});
}

TEST(GltfColor, OutOfRangeIsClampedAndWrongCountsAreErrors) {
  expectColors(colored(bytesOf<float>({2, -1, .5f, 1, 0, 0, 0, .5f, 0}),
                       R"("componentType": 5126, "count": 3, "type": "VEC3")"),
               {{1, 0, .5f, 1}, {1, 0, 0, 1}, {0, .5f, 0, 1}});
  EXPECT_CONTAINS(errorOf([] {
                    colored(bytesOf<float>({0, 0, 0, 1, 1, 1}),
                            R"("componentType": 5126, "count": 2, "type": "VEC3")");
                  }),
                  "COLOR_0 has 2 elements for 3 vertices");
}

TEST(GltfColor, IsKeptByASavedScene) {
  const Scene scene = colored(bytesOf<float>({.8f, .2f, .1f, .25f, 1, 0, 0, 0, 0, .5f, 0, 1}),
                              R"("componentType": 5126, "count": 3, "type": "VEC4")");
  const TempFolder folder;
  const auto path = folder.path() / "saved.glb";
  writeGltf(path, scene);
  EXPECT_EQ(readScene(path).meshes[0].colors, scene.meshes[0].colors);
}

}  // namespace
}  // namespace ninefold
