#include <gtest/gtest.h>

#include "common/image/layers.h"
#include "common/scene/texel_ranges.h"
#include "tests/scene/one_line_error.h"
#include "tests/scene/one_material.h"

namespace ninefold {
namespace {

bool folds(float metallic, float roughness, float specular = 1) {
  Material m;
  m.metallic = metallic, m.roughness = roughness, m.specular = specular;
  return foldsIntoDiffuse(Scene{}, m);
}

TEST(Needs, FoldingRule) {
  EXPECT_TRUE(folds(0, 0.6f));
  EXPECT_FALSE(folds(0, 0.59f));
  EXPECT_TRUE(folds(1, 0.85f));
  EXPECT_FALSE(folds(1, 0.84f));
  EXPECT_TRUE(folds(0, 0, 0)) << "no specular, no lobe";
  EXPECT_FALSE(folds(1, 0, 0)) << "KHR_materials_specular does not touch metals";
}

TEST(Needs, FoldingLooksAtTheSmoothestTexel) {
  Material m = matte();
  m.metallicRoughnessMap.image = 0;
  Scene scene = withMaterial(m);
  scene.images.push_back({"map", 2, 1, 3, false, {0, 255, 0, 0, 200, 0}});
  EXPECT_TRUE(foldsIntoDiffuse(scene, m));
  scene.images[0].texels[4] = 100;
  EXPECT_FALSE(foldsIntoDiffuse(scene, m));
}

// Kept once, the ranges answer: nobody looks at the texels again, which edits do not change.
TEST(Needs, OfAFinishedSceneComeFromRangesThatWereKept) {
  Scene scene = simpleScene();
  scene.images.push_back({"map", 2, 1, 3, false, {9, 255, 0, 7, 200, 0}});
  keepTexelRanges(scene);
  ASSERT_TRUE(scene.images[0].ranges.has_value());
  const TexelRanges& ranges = *scene.images[0].ranges;
  EXPECT_EQ(ranges[0].low, 7);
  EXPECT_EQ(ranges[0].high, 9);
  EXPECT_EQ(ranges[1].low, 200);
  EXPECT_EQ(ranges[1].high, 255);
  Material m = matte();
  m.metallicRoughnessMap.image = 0;
  EXPECT_TRUE(foldsIntoDiffuse(scene, m));
  scene.images[0].texels[4] = 100;
  EXPECT_TRUE(foldsIntoDiffuse(scene, m)) << "the texels were asked";
  keepTexelRanges(scene);
  EXPECT_FALSE(foldsIntoDiffuse(scene, m));
}

TEST(Needs, ADiffuseSceneNeedsNothing) {
  const Needs needs = needsWith(matte());
  EXPECT_FALSE(needs.specular());
  EXPECT_FALSE(needs.roughSpecular);
  EXPECT_FALSE(needs.textures);
  EXPECT_EQ(needs.layerMask(), kDiffuseBit);
  const std::vector<std::string> lines = describe(needs);
  EXPECT_EQ(lines[0], "reflection layer: off, no surface reflects other than diffusely");
  EXPECT_EQ(lines[1], "transmission layer: off, no surface lets light through");
  EXPECT_EQ(lines[2], "caustic photons: off, no surface can focus light");
}

TEST(Needs, MirrorsReflectAndGlassDoesBoth) {
  Material mirror;
  mirror.roughness = 0;
  EXPECT_EQ(needsWith(mirror).layerMask(), kDiffuseBit | kReflectionBit);
  EXPECT_FALSE(needsWith(mirror).roughSpecular);
  mirror.roughness = 0.3f;
  EXPECT_TRUE(needsWith(mirror).roughSpecular);
  Material glass = matte();
  glass.transmission = 1, glass.roughness = 0;
  EXPECT_EQ(needsWith(glass).layerMask(), kDiffuseBit | kReflectionBit | kTransmissionBit);
}

// Photons are for what bends or mirrors light narrowly; glossy surfaces have VPLs, and what passes
// straight on has shadow rays.
TEST(Needs, PhotonsAreForWhatFocusesLight) {
  Material metal;
  metal.metallic = 1;
  for (const float roughness : {0.0f, 0.39f, 0.4f, 0.84f, 0.85f}) {
    metal.roughness = roughness;
    EXPECT_EQ(needsWith(metal).caustics, roughness < 0.4f) << roughness;
    EXPECT_EQ(needsWith(metal).glossy, roughness >= 0.4f && roughness < 0.85f) << roughness;
  }
  Material veil = matte();
  veil.alphaMode = AlphaMode::blend, veil.opacity = 0.5f;
  EXPECT_FALSE(needsWith(veil).caustics);
  Material frosted = matte();
  frosted.transmission = 1, frosted.roughness = 0.7f;
  EXPECT_TRUE(needsWith(frosted).caustics) << "what passes rough glass is bent";
  EXPECT_FALSE(needsWith(frosted).glossy);
}

TEST(Needs, BlendingNeedsTransmissionOnlyIfAnythingIsTransparent) {
  Material m = matte();
  m.alphaMode = AlphaMode::blend;
  EXPECT_FALSE(needsWith(m).transmission);
  m.opacity = 0.5f;
  EXPECT_TRUE(needsWith(m).transmission);
  EXPECT_FALSE(needsWith(m).reflection);
  m.opacity = 1, m.baseColorMap.image = 0;
  Scene scene = withMaterial(m);
  scene.images.push_back({"rgb", 1, 1, 3, true, {1, 2, 3}});
  EXPECT_FALSE(needsOf(scene, Radiance(0)).transmission);
  scene.images[0] = {"rgba", 1, 1, 4, true, {1, 2, 3, 200}};
  EXPECT_TRUE(needsOf(scene, Radiance(0)).transmission);
}

TEST(Needs, OnlyMaterialsThatAreSeenCount) {
  Scene scene = withMaterial(matte());
  Material glass;
  glass.transmission = 1;
  scene.materials.push_back(glass);
  EXPECT_FALSE(needsOf(scene, Radiance(0)).specular());
}

TEST(Needs, KindsOfLight) {
  Scene scene = withMaterial(matte());
  EXPECT_FALSE(needsOf(scene, Radiance(0)).environment);
  EXPECT_TRUE(needsOf(scene, Radiance(1)).environment);
  scene.lights.emplace_back();
  EXPECT_TRUE(needsOf(scene, Radiance(0)).punctualLights);
  scene.materials[0].emission = Vec3(1);
  EXPECT_TRUE(needsOf(scene, Radiance(0)).areaLights);
}

}  // namespace
}  // namespace ninefold
