// Lamps chosen by what they bring to the view: those behind walls get less than by power, and still
// all light is there, also where the camera does not look.
#include <gtest/gtest.h>

#include "common/gi/bidirectional/lamp_choice.h"
#include "common/gi/light_set/light_set.h"
#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

constexpr int kClosedRooms = 38, kLamps = kClosedRooms + 2;

void addLamp(SceneBuilder& b, int material, float x) {
  b.quad(material, Vec3(x - 0.3f, 0.99f, -0.3f), Vec3(0.6f, 0, 0), Vec3(0, 0, 0.6f));
}

// Two rooms with a hole of 60 cm in the wall between, and others that nothing leads to. Each has a
// lamp. The camera is in the first.
Scene manyRooms() {
  SceneBuilder b;
  const int white = b.material(testing::matte(Vec3(0.7f)));
  const int lamp = b.material(testing::matte(Vec3(0), Vec3(10)));
  b.box(white, Vec3(-2, -1, -1), Vec3(2, 1, 1), true);
  constexpr float h = 0.3f;
  b.quad(white, Vec3(0, -1, -1), Vec3(0, 1 - h, 0), Vec3(0, 0, 2));
  b.quad(white, Vec3(0, h, -1), Vec3(0, 1 - h, 0), Vec3(0, 0, 2));
  b.quad(white, Vec3(0, -h, -1), Vec3(0, 2 * h, 0), Vec3(0, 0, 1 - h));
  b.quad(white, Vec3(0, -h, h), Vec3(0, 2 * h, 0), Vec3(0, 0, 1 - h));
  addLamp(b, lamp, -1), addLamp(b, lamp, 1);
  for (int i = 0; i < kClosedRooms; ++i) {
    const float x = 4 + 2.5f * static_cast<float>(i);
    b.box(white, Vec3(x - 1, -1, -1), Vec3(x + 1, 1, 1), true);
    addLamp(b, lamp, x);
  }
  return b.camera(Vec3(-0.1f, 0.2f, 0.9f), Vec3(-1.5f, -0.3f, -1), 1.2f).build();
}

// Two lamps of the same room.
Scene oneRoom() {
  SceneBuilder b;
  const int lamp = b.material(testing::matte(Vec3(0), Vec3(10)));
  b.box(b.material(testing::matte(Vec3(0.7f))), Vec3(-2, -1, -1), Vec3(2, 1, 1), true);
  addLamp(b, lamp, -0.7f), addLamp(b, lamp, 0.7f);
  return b.camera(Vec3(0, 0.2f, 0.95f), Vec3(0, -0.3f, -1), 1.2f).build();
}

Settings settingsFor(Method method) {
  Settings s = testing::small(method, 8);
  s.interleave = {1, 1};
  return s;
}

struct Chosen {
  explicit Chosen(Scene made)
      : scene(std::move(made)),
        tracer(scene, Isa::automatic),
        t(tracer, settingsFor(Method::bidirectional)),
        choice(lampChoiceFor(t, viewOf(t, seen()), true)) {}
  Settings seen() const {
    Settings s = t.settings;
    s.camera = scene.cameras.front();
    return s;
  }
  // Of the lamp of that place in the scene; all are of two triangles and of the same power.
  float share(int lamp) const {
    const auto first = static_cast<uint32_t>(2 * lamp);
    return choice.transport->streams.probability(first) +
           choice.transport->streams.probability(first + 1);
  }
  const Scene scene;
  const Tracer tracer;
  const Transport t;
  const LampChoice choice;
};

// A closed room's lamp keeps a fifth of its share by power, 1/40. All shares make 1.
TEST(LampChoice, PrefersTheLampsThatTheViewIsLitBy) {
  const Chosen c(manyRooms());
  ASSERT_NE(c.choice.transport, nullptr);
  ASSERT_NE(c.choice.standard, nullptr);
  EXPECT_GT(c.share(0), 0.5f);
  EXPECT_GT(c.share(1), 1.5f * 0.2f / kLamps);
  double sum = 0;
  for (int lamp = 0; lamp < kLamps; ++lamp) sum += double{c.share(lamp)};
  for (int lamp = 2; lamp < kLamps; ++lamp)
    EXPECT_NEAR(c.share(lamp), 0.2f / kLamps, 1e-5f) << lamp;
  EXPECT_NEAR(sum, 1, 1e-5);
}

TEST(LampChoice, IsByPowerWhereLampsAreAlike) {
  EXPECT_EQ(Chosen(oneRoom()).choice.transport, nullptr);
}

TEST(LampChoice, IsAFunctionOfSceneSettingsAndView) {
  const Chosen c(manyRooms()), again(manyRooms());
  for (int lamp = 0; lamp < kLamps; ++lamp) EXPECT_EQ(c.share(lamp), again.share(lamp));
}

TEST(LampChoice, IsByPowerInMotion) {
  const Chosen c(manyRooms());
  const Renderer renderer(c.tracer, c.seen());
  const auto transportOf = [](const std::shared_ptr<const FrameLight>& light) {
    return static_cast<const LightSet&>(*light).transport;
  };
  FrameKey key{0, 0, 0, 0.1f};
  EXPECT_NE(transportOf(renderer.light(key, 0)), nullptr);
  key.lightCameras = {c.scene.cameras.front()};
  EXPECT_EQ(transportOf(renderer.light(key, 0)), nullptr);
  const Renderer begun(c.tracer, c.seen(), &renderer);
  EXPECT_EQ(transportOf(begun.light({0, 0, 0, 0.1f}, 0)), nullptr);
}

// Mean square of the difference from `reference`, pixel by pixel.
double squaredError(const testing::Rendered& image, const testing::Rendered& reference) {
  double sum = 0;
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    const Vec3 off = image.pixels[i] - reference.pixels[i];
    sum += double{glm::dot(off, off)} / static_cast<double>(image.pixels.size());
  }
  return sum;
}

// The picture's mean is the path tracer's. By power, as the key of a view in motion wants it,
// pixels have more than twice the squared error.
TEST(LampChoice, AgreesWithThePathTracerAtLessThanHalfTheSquaredError) {
  const Scene scene = manyRooms();
  const Tracer tracer(scene, Isa::automatic);
  const auto reference = testing::render(tracer, settingsFor(Method::pathTrace), 6000);
  const auto chosen = testing::render(tracer, settingsFor(Method::bidirectional), 200);
  const double error = std::hypot(chosen.error(), reference.error());
  EXPECT_NEAR(chosen.grey(), reference.grey(), 4 * error);
  EXPECT_LT(error, 0.03 * reference.grey());
  double ofChosen = 0, byPower = 0;
  for (const uint64_t seed : {2, 3, 4, 5}) {
    Settings s = settingsFor(Method::bidirectional);
    s.seed = seed;
    ofChosen += squaredError(testing::render(tracer, s, 8), reference);
    byPower +=
        squaredError(testing::render(tracer, s, 8, nullptr, {scene.cameras.front()}), reference);
  }
  EXPECT_LT(ofChosen, 0.5 * byPower);
}

// Irradiance below lamps that the camera does not see: in the room behind the hole, and in a closed
// room, whose lamp is chosen for one light path in two hundred.
TEST(LampChoice, LosesNoLightWhereTheCameraDoesNotLook) {
  const Chosen c(manyRooms());
  for (const float x : {1.0f, 4.0f}) {
    double mean[2] = {0, 0}, square[2] = {0, 0};
    for (const Method method : {Method::instantRadiosity, Method::bidirectional}) {
      const int which = method == Method::bidirectional;
      const Settings s = settingsFor(method);
      Settings seen = s;
      seen.camera = c.scene.cameras.front();
      const Renderer renderer(c.tracer, seen);
      LightSetScratch scratch;
      RayCounts rays;
      constexpr uint32_t kFrames = 1200;
      for (uint32_t frame = 0; frame < kFrames; ++frame) {
        const auto light = renderer.light({frame, frame, 0, 0.01f}, 0);
        const auto& set = static_cast<const LightSet&>(*light);
        Receivers receivers;
        const Vec3 up(0, 1, 0);
        receivers.add({Vec3(x, -1, 0.2f), up, up, Vec3(x, -1 + 1e-5f, 0.2f)});
        gatherLightSet(set.transport != nullptr ? *set.transport : c.t, set,
                       ReceiverSamples(1, frame, 0), 1, scratch, receivers, nullptr, rays);
        const double e = double{receivers.irradiance(0).x};
        mean[which] += e / kFrames, square[which] += e * e / kFrames;
      }
    }
    double error = 0;
    for (const int i : {0, 1})
      error = std::hypot(error, std::sqrt((square[i] - mean[i] * mean[i]) / 1199));
    EXPECT_NEAR(mean[1], mean[0], 4 * error) << "at x = " << x;
    EXPECT_LT(error, 0.15 * mean[0]) << "at x = " << x;
  }
}

}  // namespace
}  // namespace ninefold
