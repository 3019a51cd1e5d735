// What is written and read again is the same scene.
#include "common/scene/gltf_writer.h"

#include <gtest/gtest.h>

#include "common/base/error.h"
#include "common/scene/edit.h"
#include "common/scene/reader.h"
#include "tests/scene/same_scene.h"
#include "tests/scene/temp_folder.h"

namespace ninefold {
namespace {

class GltfWriterTest : public testing::TestWithParam<const char*> {
 protected:
  TempFolder folder;
};

INSTANTIATE_TEST_SUITE_P(Scenes, GltfWriterTest,
                         testing::Values("cornell", "table_room", "egg_room", "office"));

TEST_P(GltfWriterTest, WhatIsReadAgainHasTheSameValues) {
  const Scene scene = readScene(std::string(NINEFOLD_SCENES "/") + GetParam() + ".glb");
  const std::string path = folder.write("saved.glb", "");
  writeGltf(path, scene);
  expectSameScene(scene, readScene(path));
}

TEST_P(GltfWriterTest, EditsAreSaved) {
  Scene scene = readScene(std::string(NINEFOLD_SCENES "/") + GetParam() + ".glb");
  PunctualLight lamp;
  lamp.kind = LightKind::spot, lamp.intensity = Vec3(3, 2, 0.5f), lamp.direction = Vec3(0, -1, 0);
  scene.lights.push_back(lamp);
  SceneEdit edit;
  ObjectEdit moved{scene.instances.back().node, DMat4(1)};
  moved.motion[3] = DVec4(0.1, 0.02, -0.05, 1);
  edit.objects.push_back(moved);
  MaterialEdit glass = editOfMaterial(scene, 0);
  glass.transmission = 0.5f, glass.ior = 1.33f, glass.emission = Vec3(7, 0.3f, 0);
  edit.materials.push_back(glass);
  const Scene after = edited(scene, edit);
  const std::string path = folder.write("edited.glb", "");
  writeGltf(path, after);
  expectSameScene(after, readScene(path));
}

TEST(GltfWriterFiles, LayersAndOrthographicCamerasAreKept) {
  const TempFolder folder;
  Scene scene = readScene(NINEFOLD_SCENES "/cornell.glb");
  for (Material& m : scene.materials) {
    m.coat = 0.5f, m.coatRoughness = 0.25f;
    m.sheenColor = Vec3(0.5f, 0.25f, 1), m.sheenRoughness = 0.75f;
  }
  scene.cameras[0].orthographicHeight = 2.5f, scene.cameras[0].verticalFov = Camera{}.verticalFov;
  writeGltf(folder.path() / "a.glb", scene);
  expectSameScene(scene, readScene(folder.path() / "a.glb"));
}

TEST(GltfWriterFiles, NamesThatAreNoUtf8DoNotKeepASceneFromBeingSaved) {
  const TempFolder folder;
  Scene scene = readScene(NINEFOLD_SCENES "/cornell.glb");
  scene.materials.front().name = "gr\xfcn";
  writeGltf(folder.path() / "a.glb", scene);
  EXPECT_EQ(readScene(folder.path() / "a.glb").materials.size(), scene.materials.size());
}

TEST_F(GltfWriterTest, TheExposureIsKept) {
  Scene scene = readScene(NINEFOLD_SCENES "/cornell.glb");
  for (const std::optional<float> exposure : {std::optional<float>(), {-1.5f}, {0.0f}}) {
    scene.exposure = exposure;
    const std::string path = folder.write("exposed.glb", "");
    writeGltf(path, scene);
    EXPECT_EQ(readScene(path).exposure, exposure);
  }
}

// Extras are anybody's: what is no exposure is left out with a warning, and is no error.
TEST_F(GltfWriterTest, WhatIsNoExposureIsNone) {
  for (const char* extras : {"51", "\"bright\"", "[1]", "null", "-1e30"}) {
    const std::string path = folder.write(
        "extras.gltf", std::string(R"({"asset":{"version":"2.0"},"scene":0,"nodes":[{"mesh":0}],
          "scenes":[{"nodes":[0],"extras":{"exposure":)") +
                           extras + R"(}}],
          "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
          "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
          "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":
          "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
    EXPECT_EQ(readScene(path).exposure, std::nullopt) << extras;
  }
}

TEST(GltfWriter, SaysWhereItCannotWrite) {
  EXPECT_THROW(writeGltf("/nonexistent/a.glb", Scene()), Error);
  EXPECT_THROW(writeGltf("a.obj", Scene()), Error);
}

}  // namespace
}  // namespace ninefold
