#include <gtest/gtest.h>

#include "common/scene/emitters.h"
#include "tests/scene/simple_scene.h"

namespace ninefold {
namespace {

DMat4 scaled(double x, double y, double z) {
  DMat4 m(1);
  m[0][0] = x, m[1][1] = y, m[2][2] = z;
  return m;
}

Scene glowing(Vec3 radiance) {
  Scene scene = simpleScene();
  scene.materials[0].emission = radiance;
  return scene;
}

Flux totalFlux(const Emitters& emitters) {
  const Scene noProfiles;
  Flux sum(0);
  for (size_t i = 0; i < emitters.size(); ++i) sum += emitters[i].flux;
  return sum;
}

// Integral over directions of what a punctual light sends out.
Flux integrate(const PunctualLight& light) {
  constexpr int kRings = 400, kSectors = 400;
  const Scene noProfiles;
  Flux sum(0);
  for (int i = 0; i < kRings; ++i)
    for (int j = 0; j < kSectors; ++j) {
      const float z = 1 - 2 * (static_cast<float>(i) + 0.5f) / kRings;
      const float phi = 2 * kPi * (static_cast<float>(j) + 0.5f) / kSectors;
      const float r = std::sqrt(1 - z * z);
      sum += Emitters::intensity(noProfiles, light, Vec3(r * std::cos(phi), r * std::sin(phi), z));
    }
  return sum * (4 * kPi / (kRings * kSectors));
}

TEST(Emitters, ASquareRadiatesPiTimesRadianceTimesArea) {
  const Scene scene = glowing(Vec3(1, 2, 3));
  const Emitters emitters(scene, Radiance(0));
  ASSERT_EQ(emitters.size(), 2u);
  EXPECT_NEAR(totalFlux(emitters).z, 3 * kPi, 1e-5f);
  EXPECT_FLOAT_EQ(emitters[0].area, 0.5f);
  EXPECT_EQ(emitters[0].normal, Vec3(0, 0, 1));
}

TEST(Emitters, DoubleSidedOnesRadiateTwice) {
  Scene scene = glowing(Vec3(1));
  scene.materials[0].doubleSided = true;
  EXPECT_NEAR(totalFlux(Emitters(scene, Radiance(0))).x, 2 * kPi, 1e-5f);
}

TEST(Emitters, MirroringKeepsTheFrontInFront) {
  // Mirrored in x, the square still faces +z: glTF turns the winding round with the matrix.
  Scene scene = glowing(Vec3(1));
  scene.instances[0].toWorld = scaled(-2, 1, 1);
  const Emitters emitters(scene, Radiance(0));
  const Emitter& e = emitters[0];
  EXPECT_EQ(e.normal, Vec3(0, 0, 1));
  EXPECT_EQ(e.b, Vec3(-2, 0, 0));  // the corners stay in the mesh's order
  EXPECT_FLOAT_EQ(e.area, 1);
  scene.instances[0].toWorld = scaled(1, 1, -1);
  EXPECT_EQ(Emitters(scene, Radiance(0))[0].normal, Vec3(0, 0, -1));
}

TEST(Emitters, FindIsTheInverseOfTheTable) {
  Scene scene = glowing(Vec3(1));
  Material dark;
  scene.materials.push_back(dark);
  Mesh grey = scene.meshes[0];
  grey.material = 1;
  scene.meshes.push_back(grey);
  scene.instances = {Instance{"a", 1, 0, DMat4(1)}, Instance{"b", 0, 1, DMat4(1)},
                     Instance{"c", 1, 2, DMat4(1)}, Instance{"d", 0, 3, scaled(3, 1, 1)}};
  const Emitters emitters(scene, Radiance(1));
  for (uint32_t instance = 0; instance < 4; ++instance)
    for (uint32_t triangle = 0; triangle < 2; ++triangle) {
      const int found = emitters.find(instance, triangle);
      EXPECT_EQ(found >= 0, instance % 2 == 1);
      if (found < 0) continue;
      EXPECT_EQ(emitters[static_cast<size_t>(found)].instance, instance);
      EXPECT_EQ(emitters[static_cast<size_t>(found)].triangle, triangle);
    }
}

// Two objects with 1/4 and 3/4 of the power, two triangles each: nine tenths of the choices by
// power, one tenth alike.
TEST(Emitters, AreChosenInProportionToTheirLargestComponent) {
  Scene scene = glowing(Vec3(1, 0, 0));
  scene.instances.push_back(Instance{"big", 0, 1, scaled(3, 1, 1)});
  const Emitters emitters(scene, Radiance(0));
  EXPECT_FLOAT_EQ(emitters.byPower().probability(0), 0.9f * 0.125f + 0.1f * 0.25f);
  EXPECT_FLOAT_EQ(emitters.byPower().probability(3), 0.9f * 0.375f + 0.1f * 0.25f);
}

TEST(Emitters, PunctualFluxIsTheIntegralOfIntensity) {
  for (const auto& [inner, outer] :
       {std::pair{0.0f, 0.7f}, {0.4f, 0.9f}, {0.99f, 1.0f}, {0.0f, 1.5707f}}) {
    PunctualLight spot;
    spot.kind = LightKind::spot, spot.intensity = Vec3(2, 1, 0.5f);
    spot.direction = Vec3(0, 0, 1), spot.innerCone = inner, spot.outerCone = outer;
    Scene scene = simpleScene();
    scene.lights = {spot};
    EXPECT_NEAR(totalFlux(Emitters(scene, Radiance(0))).x, integrate(spot).x,
                0.01f * integrate(spot).x);
  }
  PunctualLight point;
  point.intensity = Vec3(3);
  Scene scene = simpleScene();
  scene.lights = {point};
  EXPECT_NEAR(totalFlux(Emitters(scene, Radiance(0))).x, integrate(point).x, 1e-3f);
}

TEST(Emitters, ParallelLightAndEnvironmentFillTheScenesSphere) {
  Scene scene = simpleScene();
  scene.bounds = Bounds{Vec3(-1), Vec3(1)};  // R^2 = 3
  PunctualLight sun;
  sun.kind = LightKind::directional, sun.intensity = Vec3(2);
  scene.lights = {sun};
  EXPECT_NEAR(totalFlux(Emitters(scene, Radiance(0))).x, 2 * kPi * 3, 1e-4f);
  scene.lights.clear();
  const Emitters sky(scene, Radiance(1));
  ASSERT_EQ(sky.size(), 1u);
  EXPECT_EQ(sky[0].kind, EmitterKind::environment);
  EXPECT_NEAR(sky[0].flux.x, 4 * kPi * kPi * 3, 1e-3f);
}

TEST(Emitters, NothingThatIsDarkIsListed) {
  Scene scene = simpleScene();
  PunctualLight off;
  off.intensity = Vec3(0);
  scene.lights = {off};
  const Emitters emitters(scene, Radiance(0));
  EXPECT_TRUE(emitters.empty());
  EXPECT_TRUE(emitters.byPower().empty());
}

// The left half of the texture is black, the right half white.
Scene halfLit() {
  Scene scene = glowing(Vec3(4));
  scene.images.push_back({"half", 64, 1, 1, true, std::vector<uint8_t>(64, 0)});
  for (size_t x = 32; x < 64; ++x) scene.images[0].texels[x] = 255;
  scene.materials[0].emissionMap.image = 0;
  return scene;
}

TEST(Emitters, TexturedOnesAreAveragedOverTheTriangle) {
  const Scene scene = halfLit();
  EXPECT_NEAR(totalFlux(Emitters(scene, Radiance(0))).x, 0.5f * 4 * kPi, 0.3f);
}

TEST(Emitters, TrianglesUnderBlackTexelsAreNotListedAndAllOthersAre) {
  Scene scene = halfLit();
  scene.meshes[0].uv0 = {Vec2(0.1f, 0), Vec2(0.2f, 0), Vec2(0.2f, 1), Vec2(0.1f, 1)};
  EXPECT_TRUE(Emitters(scene, Radiance(0)).empty());
  // One lit texel column, between the points that are averaged, is enough to be chosen now and
  // then.
  scene = halfLit();
  std::fill(scene.images[0].texels.begin(), scene.images[0].texels.end(), uint8_t{0});
  scene.images[0].texels[0] = 255;
  scene.materials[0].emissionMap.nearest = true;
  const Emitters rare(scene, Radiance(0));
  ASSERT_EQ(rare.size(), 2u);
  EXPECT_GT(rare.byPower().probability(0), 0);
}

TEST(Emitters, PointsLieOnTheTriangleAndShineAsTheTextureSays) {
  const Scene scene = halfLit();
  const Emitters emitters(scene, Radiance(0));
  const EmitterPoint bright = emitters.pointAt(0, Vec2(0.8f, 0.1f));  // uv.x = 0.9
  EXPECT_NEAR(glm::length(bright.position - Vec3(0.9f, 0.1f, 0)), 0, 1e-6f);
  EXPECT_EQ(bright.radiance, Vec3(4));
  EXPECT_EQ(emitters.pointAt(0, Vec2(0.1f, 0.1f)).radiance, Vec3(0));
  EXPECT_LT(bright.error, 1e-5f);
}

TEST(Emitters, MaskedTexelsDoNotShine) {
  Scene scene = glowing(Vec3(1));
  scene.images.push_back({"hole", 2, 1, 4, true, {255, 255, 255, 255, 255, 255, 255, 0}});
  scene.materials[0].baseColorMap.image = 0;
  scene.materials[0].baseColorMap.nearest = true;
  scene.materials[0].alphaMode = AlphaMode::mask;
  const Emitters emitters(scene, Radiance(0));
  EXPECT_EQ(emitters.radianceOf(0, {Vec2(0.2f, 0), Vec2(0)}), Vec3(1));
  EXPECT_EQ(emitters.radianceOf(0, {Vec2(0.8f, 0), Vec2(0)}), Vec3(0));
}

// One is asked for before the table is made: the answer is that of the table.
TEST(Emitters, AreAnyIfTheTableHasOne) {
  const auto agrees = [](const Scene& scene, bool expected) {
    EXPECT_EQ(Emitters::anyIn(scene), expected);
    EXPECT_EQ(!Emitters(scene, Radiance(0)).empty(), expected);
  };
  agrees(simpleScene(), false);
  agrees(glowing(Vec3(0, 0, 0.1f)), true);
  agrees(halfLit(), true);
  Scene black = halfLit();
  std::fill(black.images[0].texels.begin(), black.images[0].texels.end(), uint8_t{0});
  agrees(black, false);
  Scene flat = glowing(Vec3(1));
  for (Vec3& p : flat.meshes[0].positions) p.x = 0;
  agrees(flat, false);
  Scene lamp = simpleScene();
  lamp.lights.resize(1);
  agrees(lamp, true);
  lamp.lights[0].intensity = Vec3(0);
  agrees(lamp, false);
}

// A lamp that is in the file twice is seen once, so it counts once; the side that it shows is part
// of it, the corner at which its triangles start is not.
TEST(Emitters, WhatIsThereTwiceShinesOnce) {
  Scene scene = glowing(Vec3(1));
  const size_t once = Emitters(scene, Radiance(0)).size();
  Mesh turned = scene.meshes[0];
  for (Triangle& t : turned.triangles) t = Triangle(t.y, t.z, t.x);
  scene.meshes.push_back(turned);
  scene.instances.push_back(Instance{"again", 1, 1, DMat4(1)});
  const Emitters emitters(scene, Radiance(0));
  EXPECT_EQ(emitters.size(), once);
  EXPECT_EQ(emitters.find(1, 1), emitters.find(0, 1));
  for (Triangle& t : scene.meshes[1].triangles) std::swap(t.y, t.z);
  EXPECT_EQ(Emitters(scene, Radiance(0)).size(), 2 * once);
  scene.materials[0].doubleSided = true;
  EXPECT_EQ(Emitters(scene, Radiance(0)).size(), once);
}

TEST(Emitters, ManyAreNoProblem) {
  Scene scene = glowing(Vec3(1));
  scene.instances.assign(10000, scene.instances[0]);
  for (size_t i = 0; i < scene.instances.size(); ++i)
    scene.instances[i].toWorld[3].x = static_cast<double>(i);
  const Emitters emitters(scene, Radiance(0));
  EXPECT_EQ(emitters.size(), 20000u);
  EXPECT_EQ(emitters.find(9999, 1), 19999);
}

}  // namespace
}  // namespace ninefold
