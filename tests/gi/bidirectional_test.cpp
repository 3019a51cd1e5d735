// The two families of VPLs of the bidirectional method: the density of places that camera points
// see, and light that comes to the eye by way of a keyhole.
#include <gtest/gtest.h>

#include "common/gi/bidirectional/camera_points.h"
#include "common/gi/bidirectional/reverse_density.h"
#include "common/gi/bidirectional/reverse_places.h"
#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

constexpr FrameKey kKey{0, 0, 0, 0.1f};

// A closed box of 2 m with a smaller one in it.
Scene boxInBox() {
  SceneBuilder b;
  const int grey = b.material(testing::matte(Vec3(0.5f), Vec3(1)));
  b.box(grey, Vec3(-1), Vec3(1), true);
  b.box(grey, Vec3(-0.4f, -0.9f, -0.4f), Vec3(0.1f, -0.2f, 0.3f), false);
  return b.camera(Vec3(0, 0, 0.9f), Vec3(0, -0.3f, -1), 1.5f).build();
}

struct Seen {
  explicit Seen(Scene seen)
      : scene(std::move(seen)),
        tracer(scene, Isa::automatic),
        t(tracer, testing::small(Method::bidirectional)) {
    Settings s = t.settings;
    s.camera = scene.cameras.front();
    views = {viewOf(t, s)};
  }
  const Scene scene;
  const Tracer tracer;
  const Transport t;
  std::vector<View> views;
  RayCounts rays;
};

// The mean of f/q over rays is the integral of f over all that some camera point sees. All of the
// ceiling is seen. With f = 1 there and 0 elsewhere:
//
//   mean of f/q = 4 m^2
//
// A missing pi, cosine or shadow ray would show.
TEST(ReverseDensity, IntegratesToTheAreaThatRaysHit) {
  Seen s(boxInBox());
  double sum = 0, squares = 0;
  constexpr int kSets = 64, kRays = 256;
  for (int k = 0; k < kSets; ++k) {
    const CameraPoints camera = cameraPoints(s.t, s.views, kKey, k, 37, s.rays);
    ASSERT_GT(camera.points.size(), 0u);
    double ofSet = 0;
    for (const ReversePlace& p : reversePlaces(s.t, camera.points, kKey, k, kRays, s.rays)) {
      if (p.place.position.y < 0.999f) continue;
      ofSet += 1 / double{reverseDensity(s.t, camera.points, p.place, p.drawnFrom, s.rays)};
    }
    sum += ofSet / kRays, squares += ofSet / kRays * (ofSet / kRays);
  }
  const double mean = sum / kSets, error = std::sqrt((squares / kSets - mean * mean) / (kSets - 1));
  EXPECT_NEAR(mean, 4, 4 * error);
  EXPECT_LT(error, 0.08);
}

// The guess has the same mean as the density, over the choice of the points.
TEST(ReverseDensity, TheGuessIsRightOnTheMean) {
  Seen s(boxInBox());
  const Place y{Vec3(0.3f, 1, 0.2f), Vec3(0, -1, 0), 1e-6f};
  double density = 0, guess = 0, square = 0;
  constexpr int kSets = 400;
  for (int k = 0; k < kSets; ++k) {
    const CameraPoints camera = cameraPoints(s.t, s.views, kKey, k, 64, s.rays);
    const double q = double{reverseDensity(s.t, camera.points, y, kNone, s.rays)};
    const double g = double{guessReverseDensity(s.t, camera.points, y, kNone, s.rays)};
    density += q / kSets, guess += g / kSets, square += (g - q) * (g - q) / kSets;
  }
  EXPECT_GT(density, 0.01);
  EXPECT_NEAR(guess, density, 4 * std::sqrt(square / kSets));
}

TEST(ReverseDensity, TheBackOfAWallIsAnotherPlace) {
  Seen s(boxInBox());
  const CameraPoints camera = cameraPoints(s.t, s.views, kKey, 0, 64, s.rays);
  const Vec3 ceiling(0.3f, 1, 0.2f), down(0, -1, 0);
  EXPECT_GT(reverseDensity(s.t, camera.points, {ceiling, down, 1e-6f}, kNone, s.rays), 0);
  EXPECT_EQ(reverseDensity(s.t, camera.points, {ceiling, -down, 1e-6f}, kNone, s.rays), 0);
}

// A view of nothing has no camera points; its VPLs are those of instant radiosity.
TEST(CameraPoints, AViewOfNothingHasNone) {
  SceneBuilder b;
  b.quad(b.material(testing::matte(Vec3(0.5f), Vec3(1))), Vec3(-1, -1, 0), Vec3(2, 0, 0),
         Vec3(0, 2, 0));
  Seen s(b.camera(Vec3(0, 0, 1), Vec3(0, 0, 2), 0.5f).build());
  EXPECT_EQ(cameraPoints(s.t, s.views, kKey, 0, 64, s.rays).points.size(), 0u);
  EXPECT_EQ(testing::render(s.tracer, testing::small(Method::bidirectional), 4).grey(), 0);
}

// The box's ceiling and its floor, seen by one view each: so many of the points belong to each.
TEST(CameraPoints, BelongToTheViewsInEqualNumbers) {
  SceneBuilder b;
  b.box(b.material(testing::matte(Vec3(0.5f), Vec3(1))), Vec3(-1), Vec3(1), true);
  Seen s(b.camera(Vec3(0), Vec3(0, 1, 0), 0.5f, Vec3(0, 0, 1)).build());
  Settings down = s.t.settings;
  down.camera = s.scene.cameras.front();
  down.camera.forward = Vec3(0, -1, 0);
  const std::vector<View> views{s.views[0], viewOf(s.t, down), s.views[0], s.views[0]};
  const Receivers points = cameraPoints(s.t, views, kKey, 0, 64, s.rays).points;
  ASSERT_EQ(points.size(), 64u);
  const auto low =
      std::count_if(points.py.begin(), points.py.begin() + 64, [](float y) { return y < -0.999f; });
  EXPECT_EQ(low, 16);
}

// Two rooms and a hole in the wall between. The lamp is in one, the camera in the other. All light
// comes through the hole: instant radiosity finds it by luck.
Scene keyhole(float halfWidth) {
  SceneBuilder b;
  const int white = b.material(testing::matte(Vec3(0.75f)));
  const int lamp = b.material(testing::matte(Vec3(0), Vec3(200)));
  b.box(white, Vec3(-2, -1, -1), Vec3(2, 1, 1), true);
  const float h = halfWidth;  // the wall at x = 0 around the hole
  b.quad(white, Vec3(0, -1, -1), Vec3(0, 1 - h, 0), Vec3(0, 0, 2));
  b.quad(white, Vec3(0, h, -1), Vec3(0, 1 - h, 0), Vec3(0, 0, 2));
  b.quad(white, Vec3(0, -h, -1), Vec3(0, 2 * h, 0), Vec3(0, 0, 1 - h));
  b.quad(white, Vec3(0, -h, h), Vec3(0, 2 * h, 0), Vec3(0, 0, 1 - h));
  b.quad(lamp, Vec3(1.2f, 0.99f, -0.3f), Vec3(0.6f, 0, 0), Vec3(0, 0, 0.6f));
  return b.camera(Vec3(-0.1f, 0.3f, 0.9f), Vec3(-1.5f, -0.2f, -1), 1.2f).build();
}

Settings inOneSet(Method method) {
  Settings s = testing::small(method, 8);
  s.interleave = {1, 1};
  return s;
}

// The hole is 16 cm wide. Nothing but the path tracer knows the answer; its error is stated.
TEST(Bidirectional, FindsLightThroughAKeyholeWhereInstantRadiosityDoesNot) {
  const Scene scene = keyhole(0.08f);
  const Tracer tracer(scene, Isa::automatic);
  const auto reference = testing::render(tracer, inOneSet(Method::pathTrace), 4000);
  const auto both = testing::render(tracer, inOneSet(Method::bidirectional), 400);
  const auto lamps = testing::render(tracer, inOneSet(Method::instantRadiosity), 400);
  const double error = std::hypot(both.error(), reference.error());
  EXPECT_NEAR(both.grey(), reference.grey(), 4 * error);
  EXPECT_LT(both.error(), 0.1 * reference.grey());
  // Its own stated error is no help here: it is that of the paths it found.
  EXPECT_LT(lamps.grey(), 0.8 * reference.grey()) << "instant radiosity finds it as well";
}

// Light that was made for other views has the same mean: for half of what the camera sees, for
// nothing that it sees, and for nothing at all.
TEST(Bidirectional, LightForOtherViewsHasTheSameMean) {
  const Scene scene = keyhole(0.3f);
  const Tracer tracer(scene, Isa::automatic);
  const Camera own = scene.cameras.front();
  Camera lampRoom = own, outside = own;
  lampRoom.eye = Vec3(0.3f, 0.3f, 0.9f), lampRoom.forward = glm::normalize(Vec3(1, -0.3f, -1));
  outside.eye = Vec3(0, 50, 0), outside.forward = Vec3(1, 0, 0);
  Settings s = inOneSet(Method::bidirectional);
  const auto alone = testing::render(tracer, s, 300);
  s.seed = 2;
  for (const std::vector<Camera>& cameras :
       {std::vector{own, lampRoom}, std::vector(kMostLightCameras, lampRoom),
        std::vector{outside}}) {
    const auto other = testing::render(tracer, s, 300, nullptr, cameras);
    const double error = std::hypot(alone.error(), other.error());
    EXPECT_NEAR(other.grey(), alone.grey(), 4 * error);
    EXPECT_LT(error, 0.15 * alone.grey());
    EXPECT_NE(other.pixels, alone.pixels);
  }
}

// The limit counts D vertices through both families, also where VPLs are kept apart by count.
TEST(Bidirectional, KeepsThePathLengthThroughAHole) {
  const Scene scene = keyhole(0.3f);
  const Tracer tracer(scene, Isa::automatic);
  for (const int length : {2, 3, 4}) {
    Settings s = inOneSet(Method::pathTrace);
    s.pathLength = length;
    const auto reference = testing::render(tracer, s, 2000);
    s.method = Method::bidirectional;
    const auto both = testing::render(tracer, s, 300);
    const double error = std::hypot(both.error(), reference.error());
    EXPECT_NEAR(both.grey(), reference.grey(), 4 * error) << "path length " << length;
    EXPECT_LT(error, 0.1 * reference.grey()) << "path length " << length;
  }
}

}  // namespace
}  // namespace ninefold
