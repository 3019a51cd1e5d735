// What of a glTF file nobody reads: told by name, and nothing else is told.
#include "common/scene/gltf_unread.h"

#include <gtest/gtest.h>

#include "common/scene/reader.h"
#include "tests/scene/gltf_bytes.h"
#include "tests/scene/temp_folder.h"

namespace ninefold {
namespace {

std::string attributes(const std::string& list) {
  return R"({"meshes": [{"primitives": [{"attributes": {)" + list + "}}]}]}";
}

std::string material(const std::string& members) {
  return R"({"materials": [{"name": "m", )" + members + "}]}";
}

TEST(GltfUnread, AttributesThatAreReadAreNotTold) {
  EXPECT_EQ(unreadOf(kTriangleJson), "");
  EXPECT_EQ(unreadOf(attributes(R"("POSITION": 0, "NORMAL": 1, "TANGENT": 2, "TEXCOORD_0": 3,
      "TEXCOORD_1": 4, "COLOR_0": 5, "JOINTS_0": 6, "WEIGHTS_0": 7, "JOINTS_12": 8)")),
            "");
}

TEST(GltfUnread, OtherAttributesAreNamedOnceEach) {
  EXPECT_EQ(unreadOf(attributes(
                R"("POSITION": 0, "TEXCOORD_2": 1, "COLOR_1": 2, "_CUSTOM": 3, "JOINTS_": 4}},
      {"attributes": {"COLOR_1": 1})")),
            "vertex attributes COLOR_1, JOINTS_, TEXCOORD_2, _CUSTOM");
  EXPECT_EQ(
      unreadOf(R"({"meshes": [{"primitives": [{"targets": [{"POSITION": 0}, {"COLOR_1": 1}]}]}]})"),
      "vertex attributes COLOR_1");
}

TEST(GltfUnread, MaterialPropertiesAreNamedWithTheirPlace) {
  EXPECT_EQ(unreadOf(material(R"("alphaMode": "MASK", "alphaCutoff": 0.5, "doubleSided": true,
      "normalTexture": {"index": 0, "scale": 2, "texCoord": 1},
      "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "emissiveFactor": [1, 1, 1])")),
            "");
  EXPECT_EQ(unreadOf(material(R"("occlusionTexture": {"index": 0, "strength": 1},
      "emissiveTexture": {"index": 0, "scale": 1}, "pbrMetallicRoughness": {"shine": 1})")),
            "material properties emissiveTexture.scale, occlusionTexture (light is computed), "
            "pbrMetallicRoughness.shine");
}

TEST(GltfUnread, ExtensionsAreNamedWhereverTheyStand) {
  EXPECT_EQ(unreadOf(material(R"("extensions": {"KHR_materials_ior": {"ior": 1.3},
      "KHR_materials_anisotropy": {"anisotropyStrength": 1}})")),
            "extensions KHR_materials_anisotropy (highlights are round)");
  EXPECT_EQ(unreadOf(R"({"extensions": {"A": {}}, "asset": {"extensions": {"B": {"a": [{}]}}},
      "bufferViews": [{"buffer": 0, "extensions": {"C": {}}}], "animations": [{"channels": [
      {"target": {"extensions": {"D": {}}}}]}], "nodes": [{"extensions": {"E": 1}}]})"),
            "extensions A, B, C, D, E");
}

TEST(GltfUnread, AnExtensionInAPlaceWhereItIsNotReadIsNamed) {
  EXPECT_EQ(unreadOf(material(R"("extensions": {"KHR_lights_punctual": {"light": 0}})")),
            "extensions KHR_lights_punctual");
  EXPECT_EQ(unreadOf(R"({"nodes": [{"extensions": {"KHR_lights_punctual": {"light": 0}}}]})"), "");
}

TEST(GltfUnread, WhatAnExtensionSaysBeyondWhatIsReadIsNamed) {
  EXPECT_EQ(unreadOf(material(R"("extensions": {"KHR_materials_volume": {"thicknessFactor": 1,
      "thicknessTexture": {"index": 0}}, "KHR_materials_specular": {"specularTexture": {"index": 0,
      "extensions": {"KHR_texture_transform": {"scale": [1, 1]}, "OTHER": {}}}}})")),
            "extensions KHR_materials_volume.thicknessTexture (as thick as the mesh is), OTHER");
}

TEST(GltfUnread, ExtensionsThatAreOnlyAnnouncedAreNamed) {
  EXPECT_EQ(unreadOf(R"({"extensionsUsed": ["KHR_mesh_quantization", "KHR_texture_transform",
      "KHR_materials_anisotropy", "KHR_lights_punctual"]})"),
            "extensions KHR_materials_anisotropy (highlights are round)");
  EXPECT_TRUE(isReadExtension("KHR_texture_transform"));
  EXPECT_FALSE(isReadExtension("KHR_texture_basisu"));
}

// Each is named once, however many materials have it.
TEST(GltfUnread, WhatThePictureShowsInsteadIsSaid) {
  EXPECT_EQ(
      unreadOf(R"({"extensionsUsed": ["KHR_materials_dispersion", "KHR_materials_iridescence"],
      "materials": [{"extensions": {"KHR_materials_dispersion": {"dispersion": 1}}},
      {"extensions": {"KHR_materials_clearcoat": {"clearcoatNormalTexture": {"index": 0}},
      "KHR_materials_dispersion": {}, "KHR_materials_iridescence": {}}},
      {"extensions": {"KHR_materials_diffuse_transmission":
                      {"diffuseTransmissionFactor": 0.5}}}]})"),
      "extensions KHR_materials_clearcoat.clearcoatNormalTexture (the coat follows the bumps "
      "below it), KHR_materials_diffuse_transmission (no light comes through diffusely), "
      "KHR_materials_dispersion (all colours refract alike), "
      "KHR_materials_iridescence (without colours of thin films)");
}

TEST(GltfUnread, ExtrasMayHoldAnything) {
  EXPECT_EQ(unreadOf(material(R"("extras": {"occlusionTexture": 1, "extensions": {"A": {}}})")),
            "");
}

TEST(GltfUnread, AllKindsAreOneLineOfBoundedLength) {
  EXPECT_EQ(unreadOf(R"({"extensionsUsed": ["A\nB"], "materials": [{"x": 1}],
      "meshes": [{"primitives": [{"attributes": {"_A": 1}}]}]})"),
            "vertex attributes _A; material properties x; extensions A B");
  std::string many = R"("_0a": 0)";
  for (int i = 1; i < 5000; ++i) many += ", \"_" + std::to_string(i) + "a\": 0";
  const std::string text = unreadOf(attributes(many + ", \"" + std::string(5000, 'z') + "\": 0"));
  EXPECT_LT(text.size(), 400u);
  EXPECT_TRUE(text.ends_with(", ...")) << text;
}

// The log is standard error.
TEST(GltfUnread, TheReaderWarnsOnce) {
  const TempFolder folder;
  const auto file = folder.write(
      "a.glb", triangleGlb(with(with(kTriangleJson, R"({"name": "paint"})",
                                     R"({"name": "paint", "occlusionTexture": {"index": 0}})"),
                                R"("POSITION": 0)", R"("POSITION": 0, "_TEMPERATURE": 0)")));
  testing::internal::CaptureStderr();
  readScene(file);
  const std::string log = testing::internal::GetCapturedStderr();
  const std::string line =
      "warning: left out, as nothing reads it: vertex attributes _TEMPERATURE; material properties "
      "occlusionTexture (light is computed)";
  const size_t at = log.find(line);
  ASSERT_NE(at, std::string::npos) << log;
  EXPECT_EQ(log.find("left out, as", at + line.size()), std::string::npos) << log;
}

}  // namespace
}  // namespace ninefold
