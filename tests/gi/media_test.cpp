// What counts where solids overlap: the smaller one, whatever order a path met them in.
#include "common/gi/light/media.h"

#include <gtest/gtest.h>

#include "common/gi/light/shading.h"
#include "common/gi/light/solid_ranks.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

TEST(MediumStack, TheHighestRankCountsInEveryOrderOfEntering) {
  std::vector<int> order{0, 1, 2, 3};  // material i of rank i
  do {
    MediumStack media;
    for (const int solid : order) media.enter(solid, solid);
    for (int innermost = 3; innermost >= 0; --innermost) {
      EXPECT_EQ(media.innermost(), innermost);
      media.leave(innermost);
    }
    EXPECT_EQ(media.innermost(), MediumStack::kAir);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(MediumStack, LeavingAnotherSolidChangesNothing) {
  MediumStack media;
  media.enter(1, 1);
  media.enter(0, 0);
  media.leave(5);
  EXPECT_EQ(media.innermost(), 1);
  media.leave(0);
  EXPECT_EQ(media.innermost(), 1);
}

TEST(MediumStack, TwoObjectsOfOneMaterialAreLeftOneByOne) {
  MediumStack media;
  media.enter(2, 0);
  media.enter(2, 0);
  media.leave(2);
  EXPECT_EQ(media.innermost(), 2);
  media.leave(2);
  EXPECT_EQ(media.innermost(), MediumStack::kAir);
}

TEST(MediumStack, TooManySolidsForgetTheLowestRank) {
  for (const int last : {0, 4}) {
    MediumStack media;
    for (int solid = 0; solid < 5; ++solid)
      if (solid != last) media.enter(solid, solid);
    media.enter(last, last);
    EXPECT_FALSE(media.contains(0));
    EXPECT_EQ(media.innermost(), 4);
  }
}

// A lamp in the pool: its light was never seen to enter the water, and goes through the ball that
// floats in it. Where the water's surface is inside the ball it is not there; beside the ball it
// refracts.
TEST(Shader, AHiddenSurfaceIsHiddenFromLightThatStartedInsideToo) {
  SceneBuilder b;
  const int water = b.material(testing::glass(1.33f)), ball = b.material(testing::glass(1.5f));
  b.box(water, Vec3(-4, -2, -4), Vec3(4, 0, 4), false).sphere(ball, Vec3(0), 0.5f, 16);
  const Scene scene = b.build();
  const Shader shader(scene);
  SurfacePoint surface;
  surface.material = water;
  surface.geometricNormal = surface.shadingNormal = Vec3(0, 1, 0);
  const Vec3 fromBelow(0, -1, 0);
  MediumStack inBall;
  shader.enter(inBall, ball);
  const ShadingPoint hidden = shader.shade(surface, fromBelow, inBall);
  EXPECT_EQ(hidden.bsdf.passThrough, 1);
  EXPECT_FALSE(hidden.bsdf.dielectric);
  const ShadingPoint there = shader.shade(surface, fromBelow, {});
  EXPECT_TRUE(there.bsdf.dielectric);
  EXPECT_FLOAT_EQ(there.bsdf.eta, 1 / 1.33f);
}

// Volumes 1, 8 and 4 pi/3 0.125 m^3.
TEST(SolidRanks, FollowTheVolumeFromLargeToSmall) {
  SceneBuilder b;
  const int wall = b.material(testing::matte(Vec3(0.5f)));
  const int cube = b.material(testing::glass(1.5f)), pool = b.material(testing::glass(1.33f)),
            ball = b.material(testing::glass(1.7f));
  b.box(wall, Vec3(-9), Vec3(9), true);
  b.box(cube, Vec3(0), Vec3(1), false).box(pool, Vec3(-7), Vec3(-5), false);
  b.sphere(ball, Vec3(3), 0.5f, 32);
  EXPECT_EQ(solidRanks(b.build()), (std::vector<int>{0, 1, 0, 2}));
}

// A cube of 2 m that an instance shrinks to 0.2 m, turns, mirrors and moves, beside one of 1 m.
TEST(SolidRanks, CountTheSizeInTheScene) {
  SceneBuilder b;
  const int shrunk = b.material(testing::glass(1.5f)), cube = b.material(testing::glass(1.33f));
  b.box(shrunk, Vec3(-1), Vec3(1), false).box(cube, Vec3(0), Vec3(1), false);
  Scene scene = b.build();
  scene.instances[0].toWorld =
      DMat4(0, 0.1, 0, 0, 0.1, 0, 0, 0, 0, 0, 0.1, 0, 50, 60, 70, 1);  // columns
  EXPECT_EQ(solidRanks(scene), (std::vector<int>{1, 0}));
}

TEST(SolidRanks, EqualsGoByTheirIndexAndThinWallsDoNotTakePart) {
  SceneBuilder b;
  Material pane = testing::glass(1.5f);
  pane.solid = false;
  const int first = b.material(testing::glass(1.5f)), thin = b.material(pane),
            second = b.material(testing::glass(1.5f));
  for (const int material : {first, thin, second}) b.box(material, Vec3(0), Vec3(1), false);
  EXPECT_EQ(solidRanks(b.build()), (std::vector<int>{0, 0, 1}));
}

}  // namespace
}  // namespace ninefold
