// How many candidates a view's sets have: few where light comes in straight, all of them where it
// comes round a corner; and the light is the same with few of them.
#include "common/gi/bidirectional/effort.h"

#include <gtest/gtest.h>

#include "common/gi/light_set/light_set.h"
#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

// Two rooms and a hole of 2 h in the wall between; the lamp is in one, the camera in the other.
// h = 1: there is no wall.
Scene rooms(float h) {
  SceneBuilder b;
  const int white = b.material(testing::matte(Vec3(0.7f)));
  b.box(white, Vec3(-2, -1, -1), Vec3(2, 1, 1), true);
  if (h < 1) {
    b.quad(white, Vec3(0, -1, -1), Vec3(0, 1 - h, 0), Vec3(0, 0, 2));
    b.quad(white, Vec3(0, h, -1), Vec3(0, 1 - h, 0), Vec3(0, 0, 2));
    b.quad(white, Vec3(0, -h, -1), Vec3(0, 2 * h, 0), Vec3(0, 0, 1 - h));
    b.quad(white, Vec3(0, -h, h), Vec3(0, 2 * h, 0), Vec3(0, 0, 1 - h));
  }
  b.quad(b.material(testing::matte(Vec3(0), Vec3(20))), Vec3(1.2f, 0.99f, -0.3f), Vec3(0.6f, 0, 0),
         Vec3(0, 0, 0.6f));
  return b.camera(Vec3(-0.1f, 0.3f, 0.9f), Vec3(-1.5f, -0.2f, -1), 1.2f).build();
}

Settings settingsFor(Method method) {
  Settings s = testing::small(method, 8);
  s.interleave = {1, 1};
  return s;
}

// r of the sets that a renderer makes of the scene.
int candidatesOf(const Scene& scene, const Settings& settings, const FrameKey& key) {
  const Tracer tracer(scene, Isa::automatic);
  Settings s = settings;
  s.camera = scene.cameras.front();
  const auto light = Renderer(tracer, s).light(key, 0);
  const auto& transport = static_cast<const LightSet&>(*light).transport;
  return transport != nullptr ? transport->settings.resampling : s.resampling;
}

TEST(Effort, IsLittleWhereLightComesInStraightAndAllWhereItComesThroughAHole) {
  Settings s = settingsFor(Method::bidirectional);
  const FrameKey key{0, 0, 0, 0.1f};
  EXPECT_EQ(candidatesOf(rooms(1), s, key), 2);
  EXPECT_EQ(candidatesOf(rooms(0.08f), s, key), 10);
  s.resampling = 4;
  EXPECT_EQ(candidatesOf(rooms(1), s, key), 4);
  s.resampling = 10, s.partition = PartitionRule::equal;
  EXPECT_EQ(candidatesOf(rooms(1), s, key), 10);
}

TEST(Effort, IsNotLookedAtInMotion) {
  const Scene scene = rooms(1);
  FrameKey key{0, 0, 0, 0.1f};
  key.lightCameras = {scene.cameras.front()};
  EXPECT_EQ(candidatesOf(scene, settingsFor(Method::bidirectional), key), 10);
}

// R and S of candidates worth 1, 1 (standard) and 2 (reverse): 2/4, and 3 (1 + 1 + 4)/16.
TEST(Effort, GoesByTheShareOfReversePlacesAndByHowUnlikeCandidatesAre) {
  const std::vector<float> values{1, 1, 2};
  const WorthSummary summary = summaryOf(values, 2);
  EXPECT_DOUBLE_EQ(summary.reverse, 0.5);
  EXPECT_DOUBLE_EQ(summary.uneven, 18.0 / 16);
  const WorthSummary easy{0.2, 5}, round{0.6, 5}, uneven{0.2, 20};
  EXPECT_TRUE(fewWillDo(std::vector{easy, easy}));
  EXPECT_FALSE(fewWillDo(std::vector{easy, round}));
  EXPECT_FALSE(fewWillDo(std::vector{easy, uneven}));
}

// Sets of which nothing is known want all candidates.
TEST(Effort, ASetWithoutLightIsNoEasyOne) {
  const std::vector<float> dark(4, 0.0f);
  const WorthSummary nothing = summaryOf(dark, 2);
  EXPECT_EQ(nothing.reverse, 1);
  EXPECT_FALSE(fewWillDo(std::vector{nothing}));
}

// With few candidates, too, the picture is the path tracer's.
TEST(Effort, LosesNoLight) {
  const Scene scene = rooms(1);
  const Tracer tracer(scene, Isa::automatic);
  const auto reference = testing::render(tracer, settingsFor(Method::pathTrace), 2000);
  const auto few = testing::render(tracer, settingsFor(Method::bidirectional), 300);
  const double error = std::hypot(few.error(), reference.error());
  EXPECT_NEAR(few.grey(), reference.grey(), 4 * error);
  EXPECT_LT(error, 0.02 * reference.grey());
}

}  // namespace
}  // namespace ninefold
