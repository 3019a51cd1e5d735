// What is written and read again is the same scene.
#include "common/scene/gltf_writer.h"

#include <gtest/gtest.h>

#include "common/base/error.h"
#include "common/scene/edit.h"
#include "common/scene/reader.h"
#include "tests/scene/temp_folder.h"

namespace ninefold {
namespace {

const Material& named(const Scene& scene, const std::string& name) {
  const auto found = std::ranges::find(scene.materials, name, &Material::name);
  EXPECT_NE(found, scene.materials.end()) << name;
  return *found;
}

void expectNear(Vec3 a, Vec3 b, float ulps = 2) {
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(a[i], b[i], ulps * 1.2e-7f * std::max(1e-30f, std::abs(a[i])));
}

void expectSameUse(const Scene& a, const TextureUse& ua, const Scene& b, const TextureUse& ub) {
  ASSERT_EQ(bool(ua), bool(ub));
  if (!ua) return;
  const TextureImage& ia = a.images[static_cast<size_t>(ua.image)];
  const TextureImage& ib = b.images[static_cast<size_t>(ub.image)];
  EXPECT_EQ(ia.texels, ib.texels);
  EXPECT_EQ(ia.srgb, ib.srgb);
  EXPECT_EQ(std::tuple(ua.uvSet, ua.offset, ua.scale, ua.rotation, ua.wrapS, ua.wrapT, ua.nearest),
            std::tuple(ub.uvSet, ub.offset, ub.scale, ub.rotation, ub.wrapS, ub.wrapT, ub.nearest));
}

void expectSameMaterial(const Scene& a, const Material& ma, const Scene& b, const Material& mb) {
  EXPECT_EQ(std::tuple(ma.baseColor, ma.opacity, ma.alphaMode, ma.alphaCutoff, ma.metallic,
                       ma.roughness, ma.normalScale, ma.doubleSided),
            std::tuple(mb.baseColor, mb.opacity, mb.alphaMode, mb.alphaCutoff, mb.metallic,
                       mb.roughness, mb.normalScale, mb.doubleSided));
  EXPECT_EQ(std::tuple(ma.transmission, ma.ior, ma.specular, ma.specularColor, ma.solid,
                       ma.attenuationColor, ma.attenuationDistance),
            std::tuple(mb.transmission, mb.ior, mb.specular, mb.specularColor, mb.solid,
                       mb.attenuationColor, mb.attenuationDistance));
  expectNear(ma.emission, mb.emission);
  expectSameUse(a, ma.baseColorMap, b, mb.baseColorMap);
  expectSameUse(a, ma.metallicRoughnessMap, b, mb.metallicRoughnessMap);
  expectSameUse(a, ma.normalMap, b, mb.normalMap);
  expectSameUse(a, ma.emissionMap, b, mb.emissionMap);
}

void expectSameScene(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.instances.size(), b.instances.size());
  const float size = a.bounds.radius();
  for (size_t i = 0; i < a.instances.size(); ++i) {
    const Instance &ia = a.instances[i], &ib = b.instances[i];
    EXPECT_EQ(ia.name, ib.name);
    const Mesh& ma = a.meshes[static_cast<size_t>(ia.mesh)];
    const Mesh& mb = b.meshes[static_cast<size_t>(ib.mesh)];
    EXPECT_EQ(ma.positions, mb.positions);
    EXPECT_EQ(ma.triangles, mb.triangles);
    EXPECT_EQ(ma.uv0, mb.uv0);
    EXPECT_EQ(ma.normals.size(), mb.normals.size());
    for (int c = 0; c < 3; ++c) EXPECT_EQ(ia.toWorld[c], ib.toWorld[c]);
    const DVec3 pa = DVec3(ia.toWorld[3]) + a.origin, pb = DVec3(ib.toWorld[3]) + b.origin;
    EXPECT_NEAR(glm::length(pa - pb), 0, 1e-12 * double(size));
    const Material& one = a.materials[static_cast<size_t>(ma.material)];
    expectSameMaterial(a, one, b, named(b, one.name));
  }
  ASSERT_EQ(a.cameras.size(), b.cameras.size());
  for (size_t i = 0; i < a.cameras.size(); ++i) {
    EXPECT_NEAR(glm::length(a.cameras[i].forward - b.cameras[i].forward), 0, 1e-6f);
    EXPECT_NEAR(
        glm::length(DVec3(a.cameras[i].eye) + a.origin - DVec3(b.cameras[i].eye) - b.origin), 0,
        1e-6 * double(size));
    EXPECT_EQ(a.cameras[i].verticalFov, b.cameras[i].verticalFov);
  }
  ASSERT_EQ(a.lights.size(), b.lights.size());
  for (size_t i = 0; i < a.lights.size(); ++i) {
    EXPECT_EQ(a.lights[i].kind, b.lights[i].kind);
    expectNear(a.lights[i].intensity, b.lights[i].intensity);
    EXPECT_NEAR(glm::length(a.lights[i].direction - b.lights[i].direction), 0, 1e-6f);
  }
}

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

TEST(GltfWriter, SaysWhereItCannotWrite) {
  EXPECT_THROW(writeGltf("/nonexistent/a.glb", Scene()), Error);
  EXPECT_THROW(writeGltf("a.obj", Scene()), Error);
}

}  // namespace
}  // namespace ninefold
