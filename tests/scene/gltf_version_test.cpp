// What a glTF file needs that is not there is said by name. Versions: glTF 2.0, 3.2: minVersion
// decides where it is given, else the major version of `version`.
#include <gtest/gtest.h>

#include "common/scene/reader.h"
#include "tests/scene/gltf_bytes.h"
#include "tests/scene/one_line_error.h"
#include "tests/scene/temp_folder.h"

namespace ninefold {
namespace {

Scene readJson(const std::string& json) {
  const TempFolder folder;
  return readScene(folder.write("scene.glb", triangleGlb(json)));
}

std::string errorOfAsset(const std::string& asset) {
  return errorOf([&] { readJson(with(kTriangleJson, R"({"version": "2.0"})", asset)); });
}

std::string warningsOfAsset(const std::string& asset) {
  testing::internal::CaptureStderr();
  readJson(with(kTriangleJson, R"({"version": "2.0"})", asset));
  return testing::internal::GetCapturedStderr();
}

TEST(GltfVersion, OthersThanTwoAreRefused) {
  EXPECT_CONTAINS(errorOfAsset(R"({"version": "1.0"})"),
                  "needs glTF version 1.0, only 2.0 is supported: export as glTF 2.0");
  EXPECT_CONTAINS(errorOfAsset(R"({"version": "1.1"})"), "needs glTF version 1.1");
  EXPECT_CONTAINS(errorOfAsset(R"({"version": "3.0"})"), "needs glTF version 3.0");
  EXPECT_CONTAINS(errorOfAsset(R"({"version": "20.0"})"), "needs glTF version 20.0");
  EXPECT_CONTAINS(errorOfAsset(R"({"version": "2.1", "minVersion": "2.1"})"),
                  "needs glTF version 2.1");
}

// glTF 1.0 has objects where 2.0 has lists; the version is what to say of it all the same.
TEST(GltfVersion, IsNamedAlsoWhereTheRestCannotBeRead) {
  const TempFolder folder;
  const auto file = folder.write(
      "old.gltf", R"({"asset": {"version": "1.0"}, "meshes": {"m": {}}, "nodes": {"n": {}}})");
  EXPECT_CONTAINS(errorOf([&] { readScene(file); }), "needs glTF version 1.0");
}

TEST(GltfVersion, NewerOnesThatCanBeReadAreReadWithAWarning) {
  EXPECT_EQ(warningsOfAsset(R"({"version": "2.0", "minVersion": "2.0"})").find("glTF version"),
            std::string::npos);
  EXPECT_CONTAINS(warningsOfAsset(R"({"version": "2.7"})"), "glTF version 2.7 is read as 2.0");
  EXPECT_CONTAINS(warningsOfAsset(R"({"version": "3.0", "minVersion": "2.0"})"),
                  "glTF version 3.0 is read as 2.0");
}

TEST(GltfVersion, RequiredExtensionsAreNamedBeforeWhatTheyBreak) {
  const auto error = [](const char* name, const std::string& json) {
    return errorOf([&] {
      readJson(with(json, R"("scene": 0)",
                    R"("extensionsRequired": [")" + std::string(name) + R"("], "scene": 0)"));
    });
  };
  const std::string noView = with(kTriangleJson, R"({"bufferView": 0, "componentType": 5126,)",
                                  R"({"componentType": 5126,)");
  const std::string noData = with(kTriangleJson, R"("buffers": [{"byteLength": 48}])",
                                  R"("buffers": [{"byteLength": 48}, {"byteLength": 9}])");
  for (const char* name : {"VENDOR_compression", "KHR_materials_magic"})
    for (const std::string& json : {kTriangleJson, noView, noData})
      EXPECT_CONTAINS(error(name, json), std::string("needs the glTF extension ") + name);
}

// Also where the file requires them: the texture is what must be exported in another way.
TEST(GltfVersion, ImageFormatsWithoutAFallbackAreNamed) {
  const std::string json =
      with(kTriangleJson, R"([{"name": "paint"}])",
           R"([{"name": "paint", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
              "textures": [{"extensions": {"KHR_texture_basisu": {"source": 0}}}],
              "images": [{"uri": "x.ktx2"}])");
  const std::string line =
      "texture 0 names no PNG or JPEG image, only 'x.ktx2' of KHR_texture_basisu: export it as one "
      "of them";
  EXPECT_CONTAINS(errorOf([&] { readJson(json); }), line);
  EXPECT_CONTAINS(errorOf([&] {
                    readJson(with(json, R"("scene": 0)",
                                  R"("extensionsRequired": ["KHR_texture_basisu"], "scene": 0)"));
                  }),
                  line);
}

// An accessor without a buffer view is all zeros, with sparse values on top (glTF 2.0, 3.6.2).
TEST(GltfVersion, AccessorsWithoutDataAreZeros) {
  std::string json = with(kTriangleJson, R"({"POSITION": 0})", R"({"POSITION": 0, "NORMAL": 2})");
  json = with(json, R"("type": "SCALAR"})",
              R"("type": "SCALAR"}, {"componentType": 5126, "count": 3, "type": "VEC3"})");
  const Scene scene = readJson(json);
  EXPECT_EQ(scene.meshes[0].normals, std::vector<Vec3>(3, Vec3(0, 0, 1)));  // zero: as the surface
}

}  // namespace
}  // namespace ninefold
