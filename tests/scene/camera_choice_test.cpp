#include <gtest/gtest.h>

#include "common/scene/camera_choice.h"
#include "common/scene/scene_draft.h"
#include "tests/scene/one_line_error.h"
#include "tests/scene/simple_scene.h"

namespace ninefold {
namespace {

Scene withCameras(const std::vector<std::string>& names) {
  Scene scene = simpleScene();
  scene.cameras.clear();
  for (const std::string& name : names) {
    Camera camera;
    camera.name = name;
    scene.cameras.push_back(camera);
  }
  return scene;
}

TEST(CameraChoice, ByNothingNameAndIndex) {
  const Scene scene = withCameras({"front", "door", "0"});
  EXPECT_EQ(chooseCamera(scene, "").name, "front");
  EXPECT_EQ(chooseCamera(scene, "door").name, "door");
  EXPECT_EQ(chooseCamera(scene, "1").name, "door");
  EXPECT_EQ(chooseCamera(scene, "0").name, "0");  // a name wins
}

TEST(CameraChoice, SpecIsInTheFilesCoordinates) {
  Scene scene = withCameras({"front"});
  scene.origin = DVec3(100000, 0, 0);
  const Camera camera = chooseCamera(scene, "100000,1,3.9:100000,1,0:40");
  EXPECT_EQ(camera.eye, Vec3(0, 1, 3.9f));
  EXPECT_EQ(camera.forward, Vec3(0, 0, -1));
  EXPECT_EQ(camera.up, Vec3(0, 1, 0));
  EXPECT_FLOAT_EQ(camera.verticalFov, 40 * kPi / 180);
}

TEST(CameraChoice, LookingStraightDownHasAnUp) {
  const Camera camera = chooseCamera(withCameras({"a"}), "0,5,0:0,0,0:60");
  EXPECT_GT(glm::length(glm::cross(camera.forward, camera.up)), 0.9f);
}

TEST(CameraChoice, WhatIsToldOfACameraIsThatCamera) {
  Scene scene = withCameras({"a"});
  scene.origin = DVec3(3, -200, 0.5);
  Camera camera = scene.cameras[0];
  camera.eye = Vec3(0.25f, 1.7f, -3.1f), camera.verticalFov = 0.71f;
  camera.forward = glm::normalize(Vec3(0.3f, -0.2f, -1));
  const Camera told = chooseCamera(scene, specOf(scene, camera));
  EXPECT_NEAR(glm::length(told.eye - camera.eye), 0, 1e-6f);
  EXPECT_NEAR(glm::length(told.forward - camera.forward), 0, 1e-6f);
  EXPECT_NEAR(told.verticalFov, camera.verticalFov, 1e-6f);
}

TEST(CameraChoice, AHeightInMetresMakesItOrthographic) {
  Scene scene = withCameras({"a"});
  const Camera camera = chooseCamera(scene, "0,1,4:0,1,0:2.5m");
  EXPECT_FLOAT_EQ(camera.orthographicHeight, 2.5f);
  EXPECT_EQ(camera.eye, Vec3(0, 1, 4));
  const Camera told = chooseCamera(scene, specOf(scene, camera));
  EXPECT_EQ(told.orthographicHeight, camera.orthographicHeight);
}

TEST(CameraChoice, EverythingElseIsAnErrorThatListsTheCameras) {
  const Scene scene = withCameras({"front", "door"});
  EXPECT_EQ(errorOf([&] { chooseCamera(scene, "window"); }),
            "no camera 'window': the scene has 0 'front', 1 'door'; or give eye:target:fov as "
            "x,y,z:x,y,z:degrees (or :5m, orthographic, 5 m high)");
  for (const char* bad :
       {"2", "-1", "1.5", "0,0,0:0,0,1", "0,0,0:0,0,0:40", "0,0,0:0,0,1:0", "0,0,0:0,0,1:180",
        "0,0:0,0,1:40", "0,0,0,0:0,0,1:40", "0,0,nan:0,0,1:40", "0,0,0:0,0,1:40:7",
        "0,0,0:0,0,1:0m", "0,0,0:0,0,1:m", "0,0,0:0,0,1:1e10m", "0,0,0:0,0,1:3 m", ":::", " 0"})
    EXPECT_FALSE(errorOf([&] { chooseCamera(scene, bad); }).empty()) << bad;
}

TEST(FramingCamera, SeesAllOfRoomsAndOfFlatThings) {
  for (const Vec3 half : {Vec3(1, 1, 1), Vec3(5, 1.5f, 4), Vec3(0.1f, 8, 0.1f), Vec3(3, 0, 3),
                          Vec3(0, 0, 1), Vec3(2, 2, 0)}) {
    const Bounds bounds{-half, half};
    const Camera camera = framingCamera(bounds);
    const float tangent = std::tan(0.5f * camera.verticalFov);
    const Vec3 right = glm::normalize(glm::cross(camera.forward, camera.up));
    const Vec3 up = glm::cross(right, camera.forward);
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p = half * Vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
      const Vec3 d = p - camera.eye;
      const float depth = glm::dot(d, camera.forward);
      EXPECT_GT(depth, 0);
      EXPECT_LE(std::abs(glm::dot(d, right)), depth * tangent);
      EXPECT_LE(std::abs(glm::dot(d, up)), depth * tangent);
    }
  }
}

}  // namespace
}  // namespace ninefold
