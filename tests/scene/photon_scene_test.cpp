// A simpler scene for photons: what goes to clients, and what photons meet.
#include "common/scene/photon_scene.h"

#include <gtest/gtest.h>

#include "common/base/error.h"
#include "common/scene/world.h"
#include "tests/scene/one_line_error.h"
#include "tests/scene/simple_scene.h"

namespace ninefold {
namespace {

TextureImage onePixel(uint8_t value) {
  TextureImage image;
  image.width = image.height = image.channels = 1, image.srgb = true;
  image.texels = {value};
  return image;
}

// A wall, and a lamp of the same mesh's form, with a material and an image of its own.
Scene litScene() {
  Scene scene = simpleScene();
  scene.images = {onePixel(100)};
  Material lamp;
  lamp.emission = Vec3(3), lamp.emissionMap.image = 0;
  scene.materials.push_back(lamp);
  Mesh square = scene.meshes[0];
  square.material = 1;
  scene.meshes.push_back(square);
  Instance hung;
  hung.mesh = 1, hung.node = 1, hung.toWorld[3] = DVec4(0, 0, 5, 1);
  scene.instances.push_back(hung);
  scene.bounds = boundsOf(scene);
  return scene;
}

Scene shining() {
  Scene simple = simpleScene();
  simple.images = {onePixel(7)};
  simple.materials[0].emission = Vec3(9);
  simple.materials[0].baseColorMap.image = simple.materials[0].emissionMap.image = 0;
  simple.instances[0].toWorld[3] = DVec4(1, 2, 3, 1);
  simple.origin = DVec3(10, 0, 0);
  simple.bounds = boundsOf(simple);
  return simple;
}

TEST(PhotonScene, GoesWithTheSceneAndLeavesWhatIsSeen) {
  const Scene alone = litScene();
  Scene scene = alone;
  scene.origin = DVec3(4, 0, 0);
  addPhotonScene(scene, shining());
  EXPECT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.bounds.high, alone.bounds.high);
  ASSERT_EQ(scene.photonInstances.size(), 1u);
  const Instance& instance = scene.photonInstances[0];
  EXPECT_EQ(worldPoint(instance.toWorld, Vec3(0)), Vec3(7, 2, 3));
  const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
  EXPECT_EQ(instance.mesh, 2);
  ASSERT_EQ(mesh.material, 2);
  const Material& m = scene.materials[2];
  EXPECT_EQ(m.emission, Vec3(0));
  EXPECT_EQ(scene.images[static_cast<size_t>(m.baseColorMap.image)].texels[0], 7);
  EXPECT_FALSE(m.normalMap);
}

TEST(PhotonScene, PhotonsMeetItAndTheLampsAsTheyAre) {
  Scene scene = litScene();
  addPhotonScene(scene, shining());
  scene.instances[1].toWorld[3].z = 6;
  const Scene met = photonSceneOf(scene);
  ASSERT_EQ(met.instances.size(), 2u);
  EXPECT_EQ(met.instances[0].mesh, 1);
  EXPECT_EQ(met.instances[0].toWorld[3].z, 6.0);
  EXPECT_EQ(met.instances[1].mesh, 2);
  EXPECT_TRUE(met.photonInstances.empty());
  EXPECT_GE(met.bounds.high.x, 12.0f);
  EXPECT_GE(coverBox(met).high.z, 6.0f);
}

TEST(PhotonScene, BothMustBeAValidSceneTogether) {
  Scene scene = litScene(), bad = shining();
  bad.instances[0].mesh = 1;
  EXPECT_CONTAINS(errorOf([&] { addPhotonScene(scene, bad); }), "mesh 3 does not exist");
}

}  // namespace
}  // namespace ninefold
