// Scenes also come over the wire: everything that later code relies on is checked here, field by
// field.
#include <gtest/gtest.h>

#include <functional>

#include "common/scene/reader.h"
#include "tests/scene/one_line_error.h"
#include "tests/scene/simple_scene.h"

namespace ninefold {
namespace {

Scene fullScene() {
  Scene scene = simpleScene();
  scene.images.push_back({"image", 2, 1, 3, true, std::vector<uint8_t>(6, 0)});
  scene.materials[0].baseColorMap.image = 0;
  scene.meshes[0].normals.assign(4, Vec3(0, 0, 1));
  scene.lights.emplace_back();
  return scene;
}

TEST(Validate, AcceptsAGoodScene) { EXPECT_NO_THROW(validate(fullScene())); }

TEST(Validate, RefusesEveryBrokenField) {
  const float nan = std::nanf(""), infinity = std::numeric_limits<float>::infinity();
  const std::vector<std::function<void(Scene&)>> breakers = {
      [](Scene& s) { s.meshes[0].triangles[1].y = 4; },
      [](Scene& s) { s.meshes[0].material = 1; },
      [](Scene& s) { s.meshes[0].material = -1; },
      [&](Scene& s) { s.meshes[0].positions[2].y = nan; },
      [](Scene& s) { s.meshes[0].normals.pop_back(); },
      [](Scene& s) { s.meshes[0].normals[0] = Vec3(0); },
      [](Scene& s) { s.meshes[0].uv1.resize(3); },
      [&](Scene& s) { s.meshes[0].uv0[0].x = infinity; },
      [&](Scene& s) { s.meshes[0].tangents.assign(4, Vec4(nan)); },
      [&](Scene& s) { s.meshes[0].colors.assign(4, Vec4(nan)); },
      [&](Scene& s) { s.meshes[0].colors.assign(4, Vec4(1.5f)); },
      [&](Scene& s) { s.meshes[0].colors.assign(3, Vec4(1)); },
      [](Scene& s) { s.instances[0].mesh = 1; },
      [](Scene& s) { s.instances[0].mesh = -1; },
      [](Scene& s) { s.instances[0].toWorld = DMat4(0); },
      [](Scene& s) { s.instances[0].toWorld[0] = DVec4(0); },
      [](Scene& s) { s.instances[0].toWorld[1][3] = 0.5; },
      [](Scene& s) { s.instances[0].toWorld[3][0] = std::nan(""); },
      [](Scene& s) { s.instances.clear(); },
      [](Scene& s) { s.images[0].width = 0; },
      [](Scene& s) { s.images[0].height = 100000; },
      [](Scene& s) { s.images[0].channels = 5; },
      [](Scene& s) { s.images[0].texels.pop_back(); },
      [](Scene& s) { s.materials[0].baseColorMap.image = 1; },
      [](Scene& s) { s.materials[0].baseColorMap.image = -2; },
      [](Scene& s) { s.materials[0].baseColorMap.uvSet = 2; },
      [](Scene& s) { s.materials[0].baseColorMap.wrapS = static_cast<Wrap>(9); },
      [&](Scene& s) { s.materials[0].baseColorMap.rotation = nan; },
      [](Scene& s) { s.materials[0].normalMap.image = 0; },  // an sRGB image
      [](Scene& s) { s.materials[0].baseColor.x = 1.5f; },
      [&](Scene& s) { s.materials[0].roughness = nan; },
      [](Scene& s) { s.materials[0].metallic = -1; },
      [](Scene& s) { s.materials[0].opacity = 2; },
      [](Scene& s) { s.materials[0].ior = 0; },
      [&](Scene& s) { s.materials[0].emission = Vec3(infinity); },
      [](Scene& s) { s.materials[0].transmission = 1.1f; },
      [](Scene& s) { s.materials[0].coat = 1.1f; },
      [&](Scene& s) { s.materials[0].coatRoughness = nan; },
      [](Scene& s) { s.materials[0].sheenColor.y = 1.1f; },
      [](Scene& s) { s.materials[0].sheenRoughness = -1; },
      [](Scene& s) { s.materials[0].coatMap.image = 0; },  // an sRGB image
      [](Scene& s) { s.materials[0].attenuationDistance = 0; },
      [](Scene& s) { s.materials[0].alphaMode = static_cast<AlphaMode>(3); },
      [](Scene& s) { s.lights[0].direction = Vec3(0, 0, 2); },
      [](Scene& s) { s.lights[0].intensity = Vec3(-1); },
      [](Scene& s) { s.lights[0].innerCone = 1; },
      [](Scene& s) { s.lights[0].outerCone = 2; },
      [](Scene& s) { s.lights[0].kind = static_cast<LightKind>(3); },
      [&](Scene& s) { s.lights[0].position.x = nan; },
      [](Scene& s) { s.cameras.clear(); },
      [](Scene& s) { s.cameras[0].verticalFov = 3.2f; },
      [](Scene& s) { s.cameras[0].verticalFov = 0; },
      [](Scene& s) { s.cameras[0].orthographicHeight = -1; },
      [](Scene& s) { s.cameras[0].up = s.cameras[0].forward; },
      [&](Scene& s) { s.cameras[0].eye.z = nan; },
      [](Scene& s) { s.environment = Radiance(-1); },
      [](Scene& s) { s.bounds = Bounds{}; },
      [](Scene& s) {
        s.bounds = Bounds{Vec3(-1e12f), Vec3(1e12f)};
      },
      [](Scene& s) { s.origin.x = std::nan(""); },
  };
  for (size_t i = 0; i < breakers.size(); ++i) {
    Scene scene = fullScene();
    breakers[i](scene);
    EXPECT_FALSE(errorOf([&] { validate(scene); }).empty()) << "breaker " << i;
  }
}

TEST(Validate, CountsTrianglesAfterInstancing) {
  Scene scene = simpleScene();
  scene.meshes[0].triangles.assign(1000, Triangle(0, 1, 2));
  scene.instances.assign(kMaxTriangles / 1000 + 1, scene.instances[0]);
  EXPECT_CONTAINS(errorOf([&] { validate(scene); }), "50001000 triangles, more than 50000000");
}

}  // namespace
}  // namespace ninefold
