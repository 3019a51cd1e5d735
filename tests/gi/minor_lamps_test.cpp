// Minor lamps: which they are, and that their light is neither lost nor counted twice.
#include "common/gi/light/minor_lamps.h"

#include <gtest/gtest.h>

#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

// A room with area lamps of these radiances in its ceiling, and a point light.
Scene room(const std::vector<float>& lamps, float point) {
  SceneBuilder b;
  b.box(b.material(testing::matte(Vec3(0.5f))), Vec3(-1), Vec3(1), true);
  for (size_t i = 0; i < lamps.size(); ++i) {
    const float x = -0.9f + 0.4f * static_cast<float>(i);
    b.quad(b.material(testing::matte(Vec3(0), Vec3(lamps[i]))), Vec3(x, 0.99f, -0.1f),
           Vec3(0.2f, 0, 0), Vec3(0, 0, 0.2f));
  }
  PunctualLight light;
  light.position = Vec3(0.1f, 0.2f, 0.3f), light.intensity = Vec3(point);
  b.light(light);
  b.camera(Vec3(0, 0, 0.95f), Vec3(0, -0.3f, -1), 1.2f);
  return b.build();
}

std::vector<bool> minorOf(const Scene& scene, float share) {
  const Emitters emitters(scene, Radiance(0));
  const MinorLamps minor(emitters, share, nullptr);
  std::vector<bool> is;
  for (size_t i = 0; i < emitters.size(); ++i)
    if (i == 0 || lampOf(emitters[i]) != lampOf(emitters[i - 1]))
      is.push_back(minor.has(lampOf(emitters[i])));
  return is;
}

// The lamps have 4, 1, 3 and 2 tenths of the power: pi L A = 0.04 pi L, the point light 4 pi I.
TEST(MinorLamps, AreTheFaintestThatHaveTogetherSoMuchOfThePower) {
  const Scene scene = room({4, 1, 3}, 0.02f);
  EXPECT_EQ(minorOf(scene, 0), (std::vector{false, false, false, false}));
  EXPECT_EQ(minorOf(scene, 0.05f), (std::vector{false, false, false, false}));
  EXPECT_EQ(minorOf(scene, 0.11f), (std::vector{false, true, false, false}));
  EXPECT_EQ(minorOf(scene, 0.31f), (std::vector{false, true, false, true}));
  EXPECT_EQ(minorOf(scene, 0.61f), (std::vector{false, true, true, true}));
  EXPECT_EQ(minorOf(scene, 1), (std::vector{true, true, true, true}));
}

TEST(MinorLamps, StayTheSameInAGesture) {
  const Scene before = room({4, 1, 3}, 0.02f), after = room({0.1f, 1, 3}, 0.02f);
  const Emitters then(before, Radiance(0)), now(after, Radiance(0));
  const MinorLamps begun(then, 0.11f, nullptr);
  EXPECT_EQ(MinorLamps(now, 0.11f, &begun).lamps(), begun.lamps());
  EXPECT_NE(MinorLamps(now, 0.11f, nullptr).lamps(), begun.lamps());
}

// Light that photons bring is blurred over elements, which moves it, and hides it in corners.
TEST(MinorLamps, LightIsAsMuchWhoeverBringsIt) {
  const Scene scene = room({4, 1, 3}, 0.02f);
  const Tracer tracer(scene, Isa::automatic);
  Settings s = testing::estimator(factsOf(Method::selective), 16).settings;
  const testing::Rendered virtualLights = testing::render(tracer, s, 24);
  for (const float share : {0.31f, 1.0f}) {
    s.minorLamps = share;
    const testing::Rendered photons = testing::render(tracer, s, 24);
    EXPECT_NEAR(
        photons.grey(), virtualLights.grey(),
        0.02 * virtualLights.grey() + 4 * std::hypot(photons.error(), virtualLights.error()))
        << "F = " << share;
  }
}

TEST(MinorLamps, NoneIsLeftForVirtualLightsIfAllAreMinor) {
  const Scene scene = room({4, 1, 3}, 0.02f);
  const Tracer tracer(scene, Isa::automatic);
  Settings s = testing::estimator(factsOf(Method::selective), 16).settings;
  s.minorLamps = 1;
  const testing::Rendered all = testing::render(tracer, s, 2);
  EXPECT_EQ(all.rays.shadow, 0u);
  EXPECT_GT(all.grey(), 0);
}

}  // namespace
}  // namespace ninefold
