// The two families of VPLs of the bidirectional method: the density of places that camera points
// see, and light that comes to the eye by way of a keyhole.
#include <gtest/gtest.h>

#include <functional>

#include "common/gi/bidirectional/camera_points.h"
#include "common/gi/bidirectional/reverse_density.h"
#include "common/gi/bidirectional/reverse_places.h"
#include "common/gi/bidirectional/worth.h"
#include "common/gi/light_set/light_set.h"
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

Vpl lightAt(const Place& y) {
  Vpl vpl;
  vpl.position = y.position, vpl.normal = y.normal, vpl.error = y.error;
  vpl.power = Vec3(1);
  return vpl;
}

// The guess has the same mean as the density, over the choice of the points.
TEST(ReverseDensity, TheGuessIsRightOnTheMean) {
  Seen s(boxInBox());
  const Place y{Vec3(0.3f, 1, 0.2f), Vec3(0, -1, 0), 1e-6f};
  double density = 0, guess = 0, square = 0;
  VplGatherScratch scratch;
  constexpr int kSets = 400;
  for (int k = 0; k < kSets; ++k) {
    const CameraPoints camera = cameraPoints(s.t, s.views, kKey, k, 256, s.rays);
    const double q = double{reverseDensity(s.t, camera.points, y, kNone, s.rays)};
    Worth worth(s.t, camera);
    worth.add({}, lightAt(y), scratch, s.rays);
    const double g = double{guessReverseDensity(camera, y, kNone, worth.reached())};
    density += q / kSets, guess += g / kSets, square += (g - q) * (g - q) / kSets;
  }
  EXPECT_GT(density, 0.01);
  EXPECT_NEAR(guess, density, 4 * std::sqrt(square / kSets));
}

// At a place that a ray was drawn to, the point that drew it is known to see it, among the judges or
// not. The guess is over all places' mean what the density is.
TEST(ReverseDensity, TheGuessKnowsThePointThatDrew) {
  Seen s(boxInBox());
  VplGatherScratch scratch;
  double ratio = 0;
  int count = 0;
  for (int k = 0; k < 40; ++k) {
    const CameraPoints camera = cameraPoints(s.t, s.views, kKey, k, 64, s.rays);
    Worth worth(s.t, camera);
    for (const ReversePlace& y : reversePlaces(s.t, camera.points, kKey, k, 50, s.rays)) {
      worth.add({}, lightAt(y.place), scratch, s.rays);
      const float q = reverseDensity(s.t, camera.points, y.place, y.drawnFrom, s.rays);
      const float guess = guessReverseDensity(camera, y.place, y.drawnFrom, worth.reached());
      ASSERT_GT(guess, 0);
      ratio += std::log(double{guess} / double{q}), ++count;
    }
  }
  EXPECT_GT(count, 1000);
  EXPECT_NEAR(std::exp(ratio / count), 1, 0.15);
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

// The box's ceiling by three views, its floor by one: a quarter of the points is on the floor, also
// of those that judge.
TEST(CameraPoints, BelongToTheViewsInEqualNumbers) {
  SceneBuilder b;
  b.box(b.material(testing::matte(Vec3(0.5f), Vec3(1))), Vec3(-1), Vec3(1), true);
  Seen s(b.camera(Vec3(0), Vec3(0, 1, 0), 0.5f, Vec3(0, 0, 1)).build());
  Settings down = s.t.settings;
  down.camera = s.scene.cameras.front();
  down.camera.forward = Vec3(0, -1, 0);
  const std::vector<View> views{s.views[0], viewOf(s.t, down), s.views[0], s.views[0]};
  const CameraPoints camera = cameraPoints(s.t, views, kKey, 0, 64, s.rays);
  const Receivers& points = camera.points;
  ASSERT_EQ(points.size(), 64u);
  ASSERT_EQ(camera.judges(), 16u);
  int low = 0, lowJudges = 0;
  for (size_t i = 0; i < 64; ++i) low += points.py[i] < -0.999f;
  for (size_t j = 0; j < 16; ++j) lowJudges += points.py[camera.judge(j)] < -0.999f;
  EXPECT_EQ(low, 16);
  EXPECT_EQ(lowJudges, 4);
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
    const auto reference = testing::render(tracer, s, 8000);
    s.method = Method::bidirectional;
    const auto both = testing::render(tracer, s, 800);
    const double error = std::hypot(both.error(), reference.error());
    EXPECT_NEAR(both.grey(), reference.grey(), 4 * error) << "path length " << length;
    EXPECT_LT(error, 0.04 * reference.grey()) << "path length " << length;
  }
}

// Mean irradiance at x over the light sets of `frames` frames, made for the scene's camera.
struct Measured {
  double mean = 0, error = 0;
};
Measured irradianceAt(const Tracer& tracer, Method method, Vec3 x, Vec3 n, uint32_t frames) {
  Settings s = inOneSet(method);
  s.camera = tracer.scene().cameras.front();
  const Renderer renderer(tracer, s);
  const Transport t(tracer, s);
  LightSetScratch scratch;
  RayCounts rays;
  double sum = 0, squares = 0;
  for (uint32_t frame = 0; frame < frames; ++frame) {
    const auto light = renderer.light({frame, frame, 0, 0.01f}, 0);
    Receivers receivers;
    receivers.add({x, n, n, x + 1e-5f * n});
    gatherLightSet(t, static_cast<const LightSet&>(*light), ReceiverSamples(1, frame, 0), 1,
                   scratch, receivers, nullptr, rays);
    const double e = double{receivers.irradiance(0).x};
    sum += e / frames, squares += e * e / frames;
  }
  return {sum, std::sqrt((squares - sum * sum) / (frames - 1))};
}

// The families share all paths between them, also those to points that no pixel shows. The floor
// below the lamp is in the other room.
TEST(Bidirectional, LightsPointsThatTheCameraDoesNotSee) {
  const Scene scene = keyhole(0.3f);
  const Tracer tracer(scene, Isa::automatic);
  const Vec3 x(1, -1, 0.2f), up(0, 1, 0);
  const Measured lamps = irradianceAt(tracer, Method::instantRadiosity, x, up, 2000);
  const Measured both = irradianceAt(tracer, Method::bidirectional, x, up, 2000);
  const double error = std::hypot(lamps.error, both.error);
  EXPECT_NEAR(both.mean, lamps.mean, 4 * error);
  EXPECT_LT(error, 0.02 * lamps.mean);
}

// A lamp, a block of glass and rough metal in a grey box.
Scene roomWithGlassAndMetal() {
  SceneBuilder b;
  const int grey = b.material(testing::matte(Vec3(0.6f)));
  Material metal = testing::matte(Vec3(0.8f));
  metal.metallic = 1, metal.roughness = 0.4f, metal.specular = 1;
  b.box(grey, Vec3(-1), Vec3(1), true);
  b.box(b.material(metal), Vec3(-0.8f, -1, -0.8f), Vec3(-0.2f, -0.4f, -0.2f), false);
  b.box(b.material(testing::glass(1.5f)), Vec3(0.2f, -0.9f, -0.5f), Vec3(0.6f, -0.5f, -0.1f),
        false);
  b.quad(b.material(testing::matte(Vec3(0), Vec3(20))), Vec3(-0.2f, 0.99f, -0.2f), Vec3(0.4f, 0, 0),
         Vec3(0, 0, 0.4f));
  return b.camera(Vec3(0, 0, 0.95f), Vec3(0, -0.3f, -1), 1.4f).build();
}

// Whatever caustics are asked for and however long paths may be, both methods leave out the same. With
// two D vertices few frames have most of the error.
TEST(Bidirectional, ShowsWhatInstantRadiosityShowsWhicheverCausticsAreOn) {
  const Scene scene = roomWithGlassAndMetal();
  const Tracer tracer(scene, Isa::automatic);
  const struct {
    const char* what;
    std::function<void(Settings&)> set;
    double error = 0.03;
  } cases[] = {
      {"caustics off", [](Settings& s) { s.caustics = Caustics::off; }},
      {"caustics direct", [](Settings& s) { s.caustics = Caustics::direct; }},
      {"no photons", [](Settings& s) { s.photons = 0; }},
      {"two D vertices", [](Settings& s) { s.pathLength = 2; }, 0.15},
      {"three D vertices, caustics off",
       [](Settings& s) { s.pathLength = 3, s.caustics = Caustics::off; }},
  };
  for (const auto& [what, set, limit] : cases) {
    Settings s = inOneSet(Method::instantRadiosity);
    s.photonRadius = 0.01f;
    set(s);
    const auto lamps = testing::render(tracer, s, 600);
    s.method = Method::bidirectional;
    const auto both = testing::render(tracer, s, 300);
    const double error = std::hypot(lamps.error(), both.error());
    EXPECT_NEAR(both.grey(), lamps.grey(), 4 * error) << what;
    EXPECT_LT(error, limit * lamps.grey()) << what;
  }
}

}  // namespace
}  // namespace ninefold
