// Where a dragged thing goes.
#include "master/interaction/drag.h"

#include <gtest/gtest.h>

namespace ninefold {
namespace {

constexpr int kWidth = 640, kHeight = 480;

Camera eyeLevel() {
  Camera camera;
  camera.eye = Vec3(0, 1.5f, 3);
  camera.forward = glm::normalize(Vec3(0.1f, -0.3f, -1));
  return camera;
}

Camera plan() {
  Camera camera = eyeLevel();
  camera.orthographicHeight = 3;
  return camera;
}

// Film position at which the camera sees p.
Vec2 filmAt(const Camera& camera, Vec3 p) {
  const Vec3 right = glm::normalize(glm::cross(camera.forward, camera.up));
  const Vec3 up = glm::cross(right, camera.forward), arm = p - camera.eye;
  const float height = isOrthographic(camera) ? camera.orthographicHeight
                                              : 2 * std::tan(0.5f * camera.verticalFov) *
                                                    glm::dot(arm, camera.forward);
  const float scale = kHeight / height;
  return Vec2(kWidth / 2.0f + scale * glm::dot(arm, right),
              kHeight / 2.0f - scale * glm::dot(arm, up));
}

class DragTest : public testing::TestWithParam<std::tuple<DragMode, Camera (*)()>> {};

INSTANTIATE_TEST_SUITE_P(Modes, DragTest,
                         testing::Combine(testing::Values(DragMode::ground, DragMode::vertical,
                                                          DragMode::alongX, DragMode::alongY,
                                                          DragMode::alongZ),
                                          testing::Values(&eyeLevel, &plan)));

TEST_P(DragTest, WhatIsGrabbedStaysUnderThePointerWithinItsBound) {
  const DragMode mode = std::get<0>(GetParam());
  const Camera camera = std::get<1>(GetParam())();
  const Vec3 grabbed(0.2f, 0.8f, -0.5f);
  Vec3 step(0.3f, 0, -0.2f);
  if (mode == DragMode::alongX) step = Vec3(0.4f, 0, 0);
  if (mode == DragMode::alongZ) step = Vec3(0, 0, -0.6f);
  if (mode == DragMode::alongY || mode == DragMode::vertical) step = Vec3(0, 0.3f, 0);
  Drag drag(mode, grabbed, grabbed, filmAt(camera, grabbed), DMat4(1));
  const DMat4& motion = drag.moveTo(filmAt(camera, grabbed + step), camera, kWidth, kHeight);
  EXPECT_NEAR(glm::length(DVec3(motion[3]) - DVec3(step)), 0, 1e-4);
  EXPECT_NEAR(glm::length(drag.point() - (grabbed + step)), 0, 1e-4f);
  // A pointer that leaves the bound moves the thing only within it.
  const DVec3 at(drag.moveTo(Vec2(150, 400), camera, kWidth, kHeight)[3]);
  if (mode == DragMode::ground) {
    EXPECT_NEAR(at.y, 0, 1e-12);
  }
  if (mode == DragMode::alongX) {
    EXPECT_EQ(DVec3(0, at.y, at.z), DVec3(0));
  }
}

TEST(Drag, AMotionThatWasThereStays) {
  const Camera camera = eyeLevel();
  const Vec3 grabbed(0, 0.8f, 0);
  const DMat4 before = turnAbout(DVec3(0.1, 0, 0), 0.7);
  Drag drag(DragMode::alongX, grabbed, grabbed, filmAt(camera, grabbed), before);
  const DMat4 after =
      drag.moveTo(filmAt(camera, grabbed + Vec3(0.5f, 0, 0)), camera, kWidth, kHeight);
  const DMat4 expected = shift(DVec3(0.5, 0, 0)) * before;
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(glm::length(after[i] - expected[i]), 0, 1e-4);
}

TEST(Drag, TurnsAboutTheVerticalThroughTheCentre) {
  const DVec3 centre(1, 2, 3);
  Drag drag(DragMode::turn, Vec3(1.5f, 2, 3), Vec3(centre), Vec2(100, 100), DMat4(1));
  const DMat4& motion = drag.moveTo(Vec2(100 + kHeight / 2, 50), eyeLevel(), kWidth, kHeight);
  EXPECT_NEAR(glm::length(DVec3(motion * DVec4(centre, 1)) - centre), 0, 1e-12);
  const DVec3 moved(motion * DVec4(centre + DVec3(1, 0, 0), 1));
  EXPECT_NEAR(std::atan2(-(moved.z - centre.z), moved.x - centre.x), Drag::kTurn / 2, 1e-12);
}

TEST(Drag, ARayAboveTheHorizonLeavesTheThingWhereItIs) {
  const Camera camera = eyeLevel();
  const Vec3 grabbed(0, 0.8f, 0);
  Drag drag(DragMode::ground, grabbed, grabbed, filmAt(camera, grabbed), DMat4(1));
  const DMat4 last = drag.moveTo(filmAt(camera, Vec3(0.3f, 0.8f, 0)), camera, kWidth, kHeight);
  EXPECT_EQ(drag.moveTo(Vec2(320, 0), camera, kWidth, kHeight), last);
}

}  // namespace
}  // namespace ninefold
