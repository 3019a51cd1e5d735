// A person's camera: what turns, what stays, and that time may be cut into any pieces.
#include "master/interaction/camera_control.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/seeds.h"

namespace ninefold {
namespace {

Bounds room() {
  Bounds bounds;
  bounds.add(Vec3(-4, -1.5f, -3)), bounds.add(Vec3(4, 1.5f, 3));
  return bounds;
}

Camera home() {
  Camera camera;
  camera.eye = Vec3(1, 0.5f, 2.5f);
  camera.forward = glm::normalize(Vec3(-0.3f, -0.2f, -1));
  camera.up = Vec3(0.05f, 1, 0);  // rolled a little
  camera.verticalFov = 0.9f;
  return camera;
}

// Where a point of the scene is seen, in picture heights right of and above the middle.
Vec2 seenAt(const Camera& camera, Vec3 p) {
  const Vec3 right = glm::normalize(glm::cross(camera.forward, camera.up));
  const Vec3 up = glm::cross(right, camera.forward);
  const Vec3 arm = p - camera.eye;
  const float scale = 2 * std::tan(0.5f * camera.verticalFov) * glm::dot(arm, camera.forward);
  return Vec2(glm::dot(arm, right), glm::dot(arm, up)) / scale;
}

TEST(CameraControl, StartsAsTheScenesCamera) {
  const CameraControl control(home(), room());
  const Camera camera = control.camera();
  EXPECT_EQ(camera.eye, home().eye);
  EXPECT_EQ(camera.up, home().up);
  EXPECT_EQ(camera.verticalFov, home().verticalFov);
  EXPECT_NEAR(glm::length(camera.forward - home().forward), 0, 1e-7f);
}

// One random session, the time between events cut by `pieces`.
Camera randomSession(uint32_t seed, int pieces) {
  std::mt19937 random(seed);  // of the session: the same for every cutting
  std::mt19937 cuts(seed * 31 + static_cast<uint32_t>(pieces));
  CameraControl control(home(), room());
  const auto real = [&](double most) {
    return std::uniform_real_distribution<double>(-most, most)(random);
  };
  for (int event = 0; event < 200; ++event) {
    int64_t left = std::uniform_int_distribution<int64_t>(0, 300'000'000)(random);
    for (int i = 1; i < pieces; ++i) {
      const int64_t part = std::uniform_int_distribution<int64_t>(0, left)(cuts);
      control.advance(std::chrono::nanoseconds(part));
      static_cast<void>(control.camera());  // a look changes nothing
      left -= part;
    }
    control.advance(std::chrono::nanoseconds(left));
    switch (random() % 8) {
      case 0:
      case 1:
        control.hold(static_cast<FlyKey>(random() % 6), random() % 2 == 0);
        break;
      case 2:
        control.look(real(1), real(1));
        break;
      case 3:
        control.orbit(real(1), real(1));
        break;
      case 4:
        control.pan(real(0.2), real(0.2));
        break;
      case 5:
        control.dolly(real(2));
        break;
      case 6:
        control.changeSpeed(real(2));
        break;
      case 7:
        control.hurry(random() % 2 == 0);
        break;
    }
  }
  return control.camera();
}

TEST(CameraControl, AnySplittingOfTimeGivesTheSameBits) {
  for (const uint64_t given : seedsFrom(1, 50)) {
    const Repeatable repeatable(given);
    const auto seed = static_cast<uint32_t>(given);
    const Camera whole = randomSession(seed, 1);
    for (const int pieces : {2, 3, 17}) EXPECT_EQ(randomSession(seed, pieces), whole) << pieces;
  }
}

TEST(CameraControl, FliesAtItsSpeedAndStopsAtOnce) {
  CameraControl control(home(), room());
  control.hold(FlyKey::forward, true);
  control.advance(std::chrono::seconds(2));
  const Vec3 way = control.camera().eye - home().eye;
  EXPECT_NEAR(glm::length(way), 2 * control.speed(), 1e-5);
  EXPECT_NEAR(glm::dot(glm::normalize(way), home().forward), 1, 1e-6f);
  control.hold(FlyKey::forward, false);
  EXPECT_FALSE(control.isFlying());
  const Camera stopped = control.camera();
  control.advance(std::chrono::hours(1));
  EXPECT_EQ(control.camera(), stopped);
}

TEST(CameraControl, OppositeKeysHoldStill) {
  CameraControl control(home(), room());
  control.hold(FlyKey::left, true), control.hold(FlyKey::right, true);
  EXPECT_FALSE(control.isFlying());
  control.hold(FlyKey::right, false);
  EXPECT_TRUE(control.isFlying());
  control.releaseAll();
  EXPECT_FALSE(control.isFlying());
}

TEST(CameraControl, LookTurnsInPlaceAndPitchEndsBeforeThePole) {
  CameraControl control(home(), room());
  control.look(0.3, 0);
  EXPECT_EQ(control.camera().eye, home().eye);
  const Vec3 f0 = home().forward, f1 = control.camera().forward;
  EXPECT_NEAR(std::atan2(f1.x, -f1.z) - std::atan2(f0.x, -f0.z), 0.3,
              1e-6);  // clockwise from above
  EXPECT_NEAR(f1.y, f0.y, 1e-6f);
  control.look(0, 10);
  EXPECT_NEAR(std::asin(control.camera().forward.y), CameraControl::kMaxPitch, 1e-5);
  control.look(0, -20);
  EXPECT_NEAR(std::asin(control.camera().forward.y), -CameraControl::kMaxPitch, 1e-5);
}

TEST(CameraControl, OrbitKeepsThePivotInItsPlace) {
  CameraControl control(home(), room());
  control.look(0, 0);  // level, so that the picture's up is the same before and after
  const Vec3 pivot(-0.4f, 0.1f, -0.8f);
  control.setPivot(pivot);
  const Camera before = control.camera();
  control.orbit(0.7, -0.2);
  const Camera after = control.camera();
  EXPECT_GT(glm::length(after.eye - before.eye), 0.5f);
  EXPECT_NEAR(glm::length(after.eye - pivot), glm::length(before.eye - pivot), 1e-5f);
  EXPECT_NEAR(glm::length(seenAt(after, pivot) - seenAt(before, pivot)), 0, 1e-5f);
}

TEST(CameraControl, PanMovesThePivotWithThePointer) {
  CameraControl control(home(), room());
  const Vec3 pivot = control.pivot();
  const Vec2 before = seenAt(control.camera(), pivot);
  control.pan(0.25, -0.1);
  const Vec2 moved = seenAt(control.camera(), pivot) - before;
  EXPECT_NEAR(moved.x, 0.25f, 1e-5f);
  EXPECT_NEAR(moved.y, -0.1f, 1e-5f);
}

TEST(CameraControl, DollyNeverPassesThePivot) {
  CameraControl control(home(), room());
  const Vec3 forward = control.camera().forward;
  for (int i = 0; i < 500; ++i) control.dolly(1);
  EXPECT_GT(glm::dot(control.pivot() - control.camera().eye, forward), -1e-6f);
  EXPECT_LT(glm::length(control.pivot() - control.camera().eye), 1e-4f);
  for (int i = 0; i < 5000; ++i) control.dolly(-1);
  EXPECT_TRUE(isFinite(control.camera().eye));
}

TEST(CameraControl, FramedThingsJustFit) {
  CameraControl control(home(), room());
  Bounds thing;
  thing.add(Vec3(0.9f, 0, -1.1f)), thing.add(Vec3(1.1f, 0.3f, -0.9f));
  control.frame(thing);
  const Camera camera = control.camera();
  EXPECT_NEAR(glm::length(seenAt(camera, thing.centre())), 0, 1e-5f);
  // The sphere around them touches the upper and lower edge.
  const float angle = std::asin(thing.radius() / glm::length(thing.centre() - camera.eye));
  EXPECT_NEAR(angle, 0.5f * camera.verticalFov, 1e-5f);
}

Camera plan() {
  Camera camera = home();
  camera.orthographicHeight = 4;
  return camera;
}

// Picture heights right of and above the middle, whatever the depth.
Vec2 seenInPlan(const Camera& camera, Vec3 p) {
  const Vec3 right = glm::normalize(glm::cross(camera.forward, camera.up));
  const Vec3 up = glm::cross(right, camera.forward), arm = p - camera.eye;
  return Vec2(glm::dot(arm, right), glm::dot(arm, up)) / camera.orthographicHeight;
}

TEST(CameraControl, DollyEnlargesWhatAnOrthographicCameraShows) {
  CameraControl control(plan(), room());
  control.dolly(1);
  EXPECT_LT(control.camera().orthographicHeight, 4);
  EXPECT_EQ(control.camera().eye, plan().eye);
  control.dolly(-1);
  EXPECT_NEAR(control.camera().orthographicHeight, 4, 1e-5f);
  control.dolly(1e9);
  control.dolly(1e9);
  EXPECT_GT(control.camera().orthographicHeight, 0);
}

TEST(CameraControl, PannedThingsFollowThePointerInOrthographicPictures) {
  CameraControl control(plan(), room());
  const Vec2 before = seenInPlan(control.camera(), Vec3(0.3f, 0, -1));
  control.pan(0.2, -0.1);
  const Vec2 moved = seenInPlan(control.camera(), Vec3(0.3f, 0, -1)) - before;
  EXPECT_NEAR(glm::length(moved - Vec2(0.2f, -0.1f)), 0, 1e-5f);
}

TEST(CameraControl, FramedThingsJustFitAnOrthographicPicture) {
  CameraControl control(plan(), room());
  Bounds thing;
  thing.add(Vec3(0.9f, 0, -1.1f)), thing.add(Vec3(1.1f, 0.3f, -0.9f));
  control.frame(thing);
  const Camera camera = control.camera();
  EXPECT_NEAR(glm::length(seenInPlan(camera, thing.centre())), 0, 1e-5f);
  EXPECT_NEAR(camera.orthographicHeight, 2 * thing.radius(), 1e-5f);
  EXPECT_GE(glm::dot(thing.centre() - camera.eye, camera.forward), thing.radius());
  control.reset();
  EXPECT_EQ(control.camera().orthographicHeight, 4);
  control.setOrthographicHeight(3);
  EXPECT_EQ(control.camera().orthographicHeight, 3);
}

TEST(CameraControl, APinholeHasNoHeight) {
  CameraControl control(home(), room());
  control.setOrthographicHeight(3);
  EXPECT_EQ(control.camera().orthographicHeight, 0);
}

TEST(CameraControl, StraightDownCanBeLeft) {
  Camera down = home();
  down.forward = Vec3(0, -1, 0), down.up = Vec3(1, 0, 0);  // a plan with east on top
  CameraControl control(down, room());
  control.look(0, 0.5);
  const Vec3 f = control.camera().forward;
  EXPECT_NEAR(std::atan2(f.x, -f.z), 0.5f * 3.14159265f, 1e-5f);  // the view rises eastwards
}

TEST(CameraControl, ResetGoesHomeAndNonsenseIsIgnored) {
  CameraControl control(home(), room());
  control.orbit(1, 0.3), control.setVerticalFov(0.5f), control.dolly(3);
  control.reset();
  const Camera camera = control.camera();
  EXPECT_EQ(camera.eye, home().eye);
  EXPECT_EQ(camera.verticalFov, home().verticalFov);
  const double nan = std::nan("");
  control.look(nan, 0), control.orbit(0, nan), control.pan(nan, nan), control.dolly(nan);
  control.changeSpeed(nan), control.setVerticalFov(std::nanf(""));
  EXPECT_EQ(control.camera(), camera);
  control.setVerticalFov(100);
  EXPECT_LT(control.camera().verticalFov, 3.14f);
}

// A view that was kept, with any direction: going there from there changes no bit, so that nothing
// begins anew.
TEST(CameraControl, GoingToWhereItIsChangesNothing) {
  CameraControl control(home(), room());
  for (int i = 0; i < 200; ++i) {
    control.look(0.1 * i, 0.07 * (i % 5 - 2));
    Camera kept = control.camera();
    kept.name = "view 1";
    control.go(kept);
    kept.name.clear();
    ASSERT_EQ(control.camera(), kept);
  }
}

}  // namespace
}  // namespace ninefold
