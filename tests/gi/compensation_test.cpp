// The bounded geometry term: without compensation corners are too dark, with it a furnace is exact,
// at a bound so low that most light in the corner comes back by compensation.
#include <gtest/gtest.h>

#include "tests/gi/make_scene.h"
#include "tests/gi/render.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

// Looks into a corner of the furnace room of albedo a, emission 1: L = 1/(1-a).
Scene cornerOfFurnace(float albedo) {
  SceneBuilder b;
  const int wall = b.material(testing::matte(Vec3(albedo), Vec3(1)));
  b.box(wall, Vec3(-1), Vec3(1), true).camera(Vec3(-0.3f), Vec3(-1), 0.7f);
  return b.build();
}

testing::Rendered corner(float albedo, bool compensate, int pathLength = 0) {
  const Scene scene = cornerOfFurnace(albedo);
  const Tracer tracer(scene, Isa::automatic);
  Settings s = testing::small(Method::instantRadiosity);
  s.bound = 20, s.compensate = compensate, s.pathLength = pathLength;
  s.directVpls = 16, s.indirectVpls = 64;
  return testing::render(tracer, s, 48);
}

TEST(Compensation, MakesTheFurnaceExactInItsCorner) {
  for (const float a : {0.3f, 0.7f}) {
    const auto with = corner(a, true);
    EXPECT_NEAR(with.grey(), 1 / (1 - static_cast<double>(a)), 4 * with.error() + 1e-5)
        << "albedo " << a;
    EXPECT_LT(with.error(), 0.015 * with.grey());
  }
}

TEST(Compensation, IsMissedWithoutIt) {
  const auto without = corner(0.7f, false);
  EXPECT_LT(without.grey(), 0.97 / 0.3);
}

TEST(Compensation, CountsPathVertices) {
  for (const int n : {1, 2, 3}) {
    const auto with = corner(0.5f, true, n);
    double expected = 0;
    for (int i = 0; i <= n; ++i) expected += std::pow(0.5, i);
    EXPECT_NEAR(with.grey(), expected, 4 * with.error() + 1e-5) << "path length " << n;
  }
}

// No fireflies: what the bound removes comes back by rays whose weight is at most 1.
TEST(Compensation, LeavesNoFireflies) {
  const auto with = corner(0.7f, true);
  float brightest = 0;
  for (const Vec3& p : with.pixels) brightest = std::max(brightest, p.x);
  EXPECT_LT(brightest, 2 * with.grey());
}

}  // namespace
}  // namespace ninefold
