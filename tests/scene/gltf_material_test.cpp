#include <gtest/gtest.h>

#include "common/scene/reader.h"
#include "tests/scene/gltf_bytes.h"
#include "tests/scene/one_line_error.h"
#include "tests/scene/png_bytes.h"
#include "tests/scene/temp_folder.h"

namespace ninefold {
namespace {

// The triangle with this material; `more` is put before the file's materials.
Scene readWith(const std::string& material, const std::string& more = "") {
  const TempFolder folder;
  folder.write("wood.png", png(2, 1, 3, {0, 128, 255, 10, 20, 30}));
  std::string json = with(kTriangleJson, R"([{"name": "paint"}])", "[" + material + "]");
  if (!more.empty()) json = with(json, R"("materials")", more + R"(, "materials")");
  return readScene(folder.write("scene.glb", triangleGlb(json)));
}

const std::string kTextures =
    R"("textures": [{"source": 0, "sampler": 0}], "images": [{"uri": "wood.png"}],
       "samplers": [{"wrapS": 33071, "wrapT": 33648, "magFilter": 9728}])";

TEST(GltfMaterial, DefaultsAreThoseOfGltf) {
  const Material m = readWith("{}").materials[0];
  EXPECT_EQ(m.baseColor, Vec3(1));
  EXPECT_EQ(m.metallic, 1);
  EXPECT_EQ(m.roughness, 1);
  EXPECT_EQ(m.alphaMode, AlphaMode::opaque);
  EXPECT_FALSE(m.doubleSided);
  EXPECT_EQ(m.ior, 1.5f);
  EXPECT_FALSE(m.baseColorMap);
}

TEST(GltfMaterial, CoreNumbers) {
  const Material m = readWith(R"({"pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 0.4],
      "metallicFactor": 0.5, "roughnessFactor": 0.6}, "alphaMode": "MASK", "alphaCutoff": 0.7,
      "doubleSided": true})")
                         .materials[0];
  EXPECT_EQ(m.baseColor, Vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(m.opacity, 0.4f);
  EXPECT_EQ(m.metallic, 0.5f);
  EXPECT_EQ(m.roughness, 0.6f);
  EXPECT_EQ(m.alphaMode, AlphaMode::mask);
  EXPECT_EQ(m.alphaCutoff, 0.7f);
  EXPECT_TRUE(m.doubleSided);
}

TEST(GltfMaterial, EmissionIsFactorTimesStrength) {
  const Material m = readWith(R"({"emissiveFactor": [1, 0.5, 0], "extensions":
      {"KHR_materials_emissive_strength": {"emissiveStrength": 40}}})")
                         .materials[0];
  EXPECT_EQ(m.emission, Vec3(40, 20, 0));
}

TEST(GltfMaterial, GlassIsSolidOnlyWithThickness) {
  const std::string glass =
      R"({"extensions": {"KHR_materials_transmission": {"transmissionFactor": 0.9},
      "KHR_materials_ior": {"ior": 1.33}, "KHR_materials_volume": {"thicknessFactor": THICK,
      "attenuationColor": [0.5, 0.6, 0.7], "attenuationDistance": 2}}})";
  const Material solid = readWith(with(glass, "THICK", "0.1")).materials[0];
  EXPECT_EQ(solid.transmission, 0.9f);
  EXPECT_EQ(solid.ior, 1.33f);
  EXPECT_TRUE(solid.solid);
  EXPECT_EQ(solid.attenuationColor, Vec3(0.5f, 0.6f, 0.7f));
  EXPECT_EQ(solid.attenuationDistance, 2);
  EXPECT_FALSE(readWith(with(glass, "THICK", "0")).materials[0].solid);
}

TEST(GltfMaterial, SpecularExtension) {
  const Material m = readWith(R"({"extensions": {"KHR_materials_specular":
      {"specularFactor": 0.3, "specularColorFactor": [1, 2, 0.5]}}})")
                         .materials[0];
  EXPECT_EQ(m.specular, 0.3f);
  EXPECT_EQ(m.specularColor, Vec3(1, 2, 0.5f));
}

const std::string kLayers =
    R"({"alphaMode": "OPAQUE", MORE "extensions": {"KHR_materials_clearcoat":
    {"clearcoatFactor": 0.7, "clearcoatTexture": {"index": 0}, "clearcoatRoughnessFactor": 0.2,
     "clearcoatRoughnessTexture": {"index": 0}},
    "KHR_materials_sheen": {"sheenColorFactor": [0.1, 0.2, 0.3], "sheenColorTexture": {"index": 0},
     "sheenRoughnessFactor": 0.4, "sheenRoughnessTexture": {"index": 0}}, "LAST": {}}})";

TEST(GltfMaterial, CoatAndSheen) {
  testing::internal::CaptureStderr();
  const Scene scene = readWith(with(kLayers, "MORE", ""), kTextures);
  EXPECT_EQ(testing::internal::GetCapturedStderr().find("coat"), std::string::npos);
  const Material& m = scene.materials[0];
  EXPECT_EQ(m.coat, 0.7f);
  EXPECT_EQ(m.coatRoughness, 0.2f);
  EXPECT_EQ(m.sheenColor, Vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(m.sheenRoughness, 0.4f);
  EXPECT_TRUE(m.coatMap && m.coatRoughnessMap && m.sheenColorMap && m.sheenRoughnessMap);
  EXPECT_TRUE(scene.images[static_cast<size_t>(m.sheenColorMap.image)].srgb);
  EXPECT_FALSE(scene.images[static_cast<size_t>(m.sheenRoughnessMap.image)].srgb);
  EXPECT_FALSE(scene.images[static_cast<size_t>(m.coatMap.image)].srgb);
}

// A warning says what is otherwise than the file means it.
TEST(GltfMaterial, CoatsThatAreNotAsMeantAreTold) {
  testing::internal::CaptureStderr();
  readWith(with(kLayers, "MORE", R"("name": "car", "normalTexture": {"index": 0},)"), kTextures);
  EXPECT_CONTAINS(testing::internal::GetCapturedStderr(),
                  "material 'car': its coat follows the bumps below it");
  testing::internal::CaptureStderr();
  readWith(with(with(kLayers, "MORE",
                     R"("name": "pane", "pbrMetallicRoughness": {"metallicFactor": 0},)"),
                R"("LAST")", R"("KHR_materials_transmission": {"transmissionFactor": 1}, "LAST")"),
           kTextures);
  EXPECT_CONTAINS(testing::internal::GetCapturedStderr(),
                  "material 'pane': coat and sheen are left out, as light passes through it");
}

TEST(GltfMaterial, IndexZeroMeansFullReflection) {
  EXPECT_GT(readWith(R"({"extensions": {"KHR_materials_ior": {"ior": 0}}})").materials[0].ior,
            1000);
}

TEST(GltfMaterial, TexturesCarryTransformAndSampler) {
  const Material m =
      readWith(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "extensions":
      {"KHR_texture_transform": {"offset": [0.25, 0.5], "scale": [2, 3], "rotation": 0.1, "texCoord": 1}}}}})",
               kTextures)
          .materials[0];
  ASSERT_TRUE(m.baseColorMap);
  EXPECT_EQ(m.baseColorMap.offset, Vec2(0.25f, 0.5f));
  EXPECT_EQ(m.baseColorMap.scale, Vec2(2, 3));
  EXPECT_EQ(m.baseColorMap.rotation, 0.1f);
  EXPECT_EQ(m.baseColorMap.uvSet, 1);
  EXPECT_EQ(m.baseColorMap.wrapS, Wrap::clamp);
  EXPECT_EQ(m.baseColorMap.wrapT, Wrap::mirror);
  EXPECT_TRUE(m.baseColorMap.nearest);
}

TEST(GltfMaterial, AnImageUsedAsColourAndAsDataBecomesTwo) {
  const Scene scene = readWith(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0},
      "metallicRoughnessTexture": {"index": 0}}, "emissiveTexture": {"index": 0}, "emissiveFactor": [1, 1, 1],
      "extensions": {"KHR_materials_transmission": {"transmissionTexture": {"index": 0}}}})",
                               kTextures);
  const Material& m = scene.materials[0];
  ASSERT_EQ(scene.images.size(), 2u);
  EXPECT_EQ(m.baseColorMap.image, m.emissionMap.image);
  EXPECT_EQ(m.metallicRoughnessMap.image, m.transmissionMap.image);
  EXPECT_TRUE(scene.images[static_cast<size_t>(m.baseColorMap.image)].srgb);
  EXPECT_FALSE(scene.images[static_cast<size_t>(m.metallicRoughnessMap.image)].srgb);
  EXPECT_EQ(scene.images[0].texels, (std::vector<uint8_t>{0, 128, 255, 10, 20, 30}));
}

TEST(GltfMaterial, ImagesMayLieInBufferViews) {
  Bytes bytes = triangleBytes();
  const Bytes image = png(1, 1, 3, {1, 2, 3});
  bytes.insert(bytes.end(), image.begin(), image.end());
  std::string json = with(
      kTriangleJson, R"([{"name": "paint"}])",
      R"([{"emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 0}}], "textures": [{"source": 0}],
          "images": [{"bufferView": 2, "mimeType": "image/png"}])");
  json = with(json, R"("byteLength": 12})",
              R"("byteLength": 12}, {"buffer": 0, "byteOffset": 48, "byteLength": )" +
                  std::to_string(image.size()) + "}");
  json = with(json, R"({"byteLength": 48})",
              R"({"byteLength": )" + std::to_string(bytes.size()) + "}");
  const TempFolder folder;
  EXPECT_EQ(readScene(folder.write("a.glb", glb(json, bytes))).images[0].texels,
            (std::vector<uint8_t>{1, 2, 3}));
  const std::string beyond = with(json, R"("byteOffset": 48)", R"("byteOffset": 9999999)");
  // Newer parsers look themselves and say it in words of their own.
  EXPECT_CONTAINS(errorOf([&] { readScene(folder.write("b.glb", glb(beyond, bytes))); }),
                  "its buffer");
}

TEST(GltfMaterial, MaterialsThatNothingUsesAreNotLoaded) {
  const Scene scene =
      readWith(R"({"name": "used"}, {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})",
               kTextures);
  EXPECT_EQ(scene.materials.size(), 1u);
  EXPECT_TRUE(scene.images.empty());
}

TEST(GltfMaterial, TexturesWithoutCoordinatesGiveAWarning) {
  testing::internal::CaptureStderr();
  readWith(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})", kTextures);
  EXPECT_CONTAINS(testing::internal::GetCapturedStderr(),
                  "1 meshes have textures but no texture coordinates");
}

}  // namespace
}  // namespace ninefold
