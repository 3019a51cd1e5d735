// Dielectrics of every index, one inside the other, side by side, standing on a table, with the eye
// in them. Two rooms tell: the furnace, where clear glass of any shape changes nothing (basic
// radiance; walls of albedo a that emit 1 show 1/(1-a), or 1 + ... + a^n with n diffuse vertices,
// since S vertices do not count), and a lamp seen through plane faces, where Snell and Fresnel give
// the radiance.
#include "common/bsdf/bsdf.h"
#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::number;
using testing::SceneBuilder;

constexpr float kAlbedo = 0.5f;

// The furnace [-1, 1]^3, seen from the front; `add` puts things into it.
template <typename Add>
Scene furnace(const Add& add, Vec3 eye = Vec3(0, 0.1f, 0.95f)) {
  SceneBuilder b;
  b.box(b.material(testing::matte(Vec3(kAlbedo), Vec3(1))), Vec3(-1), Vec3(1), true);
  b.camera(eye, Vec3(0.05f, -0.6f, -0.3f), 1.0f);
  add(b);
  return b.build();
}

// Tessellated spheres bend light a little wrongly at their outline: 0.2 %.
constexpr testing::Tolerance kBall{.frames = 32, .bias = 2e-3, .error = 0.02};
constexpr testing::Tolerance kPlane{.frames = 32, .bias = 1e-3, .error = 0.02};

// Few photons, spread wide: light through glass is a smooth part of what a furnace's walls get.
std::vector<testing::Estimator> estimators(int pathLength = 0) {
  auto all = testing::estimators(8, pathLength);
  all.push_back(testing::mapAtVertices(8, pathLength));
  for (auto& e : all) e.settings.photons = 500, e.settings.photonRadius = 0.02f;
  return all;
}

template <typename Add>
void expectUnchanged(const Add& add, const testing::Tolerance& t, const std::string& what = "") {
  testing::expectRadiance(furnace(add), estimators(), testing::furnaceRadiance(kAlbedo), t, what);
}

TEST(Glass, BallsOfAnyIndexAreInvisibleInAFurnace) {
  for (const float index : {1.0f, 1.0001f, 0.7f, 1.5f, 10.0f})
    expectUnchanged(
        [&](SceneBuilder& b) {
          b.sphere(b.material(testing::glass(index)), Vec3(0, -0.3f, 0), 0.4f, 32);
        },
        kBall, "index " + number(index));
}

// From outside and from inside of the ball.
TEST(Glass, DoesNotCountAsAPathVertex) {
  const Vec3 centre(0, -0.3f, 0);
  for (const Vec3 eye : {Vec3(0, 0.1f, 0.95f), centre})
    for (const int n : {1, 2}) {
      const Scene scene = furnace(
          [&](SceneBuilder& b) { b.sphere(b.material(testing::glass(1.5f)), centre, 0.4f, 32); },
          eye);
      testing::expectRadiance(scene, estimators(n), testing::furnaceRadiance(kAlbedo, n), kBall,
                              "path length " + number(n));
    }
}

// A bubble: the index of air, but a solid.
TEST(Glass, BubblesInWaterAreInvisibleInAFurnace) {
  expectUnchanged(
      [](SceneBuilder& b) {
        b.sphere(b.material(testing::glass(1.33f)), Vec3(0, -0.3f, 0), 0.5f, 32);
        b.sphere(b.material(testing::glass(1.0f)), Vec3(0.05f, -0.3f, 0), 0.25f, 32);
      },
      kBall);
}

TEST(Glass, NestedBallsAreInvisibleInAFurnace) {
  expectUnchanged(
      [](SceneBuilder& b) {
        b.sphere(b.material(testing::glass(1.33f)), Vec3(0, -0.3f, 0), 0.5f, 32);
        b.sphere(b.material(testing::glass(1.7f)), Vec3(0.05f, -0.3f, 0), 0.25f, 32);
      },
      kBall);
}

// Two blocks that share a face, and two that overlap.
TEST(Glass, TouchingAndOverlappingBlocksAreInvisibleInAFurnace) {
  for (const float end : {0.0f, 0.1f})
    expectUnchanged(
        [&](SceneBuilder& b) {
          b.box(b.material(testing::glass(1.5f)), Vec3(-0.4f, -0.7f, -0.4f), Vec3(end, 0.1f, 0.4f),
                false);
          b.box(b.material(testing::glass(1.33f)), Vec3(0, -0.7f, -0.4f), Vec3(0.4f, 0.1f, 0.4f),
                false);
        },
        kPlane, "up to " + number(end));
}

// A block that stands exactly on the floor: light must not find a way out between the two.
TEST(Glass, BlocksOnTheFloorLetNothingThroughIt) {
  expectUnchanged(
      [](SceneBuilder& b) {
        b.box(b.material(testing::glass(1.5f)), Vec3(-0.4f, -1, -0.4f), Vec3(0.4f, -0.3f, 0.4f),
              false);
      },
      kPlane);
}

TEST(Glass, ThinPanesAreInvisibleInAFurnaceAndOnAWall) {
  for (const float z : {0.1f, -1.0f})
    expectUnchanged(
        [&](SceneBuilder& b) {
          Material pane = testing::glass(1.5f);
          pane.solid = false;
          b.quad(b.material(pane), Vec3(-0.5f, -0.8f, z), Vec3(1, 0, 0), Vec3(0, 1, 0));
        },
        kPlane, "at z = " + number(z));
}

TEST(Glass, EyesInsideSeeTheFurnaceToo) {
  for (const float index : {0.7f, 1.5f, 10.0f}) {
    const Vec3 centre(0, -0.3f, 0);
    const Scene scene = furnace(
        [&](SceneBuilder& b) {
          b.sphere(b.material(testing::glass(1.33f)), centre, 0.5f, 32);
          b.sphere(b.material(testing::glass(index)), centre, 0.2f, 32);
        },
        centre);
    testing::expectRadiance(scene, estimators(), 2, kBall, "index " + number(index));
  }
}

// A pool filled to the brim, all of its faces touching the water: the floor gets the light of the
// sky (radiance 1) inside Snell's window, E = integral of (1-F) cos over it = pi (1 - F_mean)/n^2,
// where F_mean is the mean over the hemisphere outside. L = albedo E/pi for an eye under water.
TEST(Glass, FloorsUnderWaterGetTheirShareOfTheSky) {
  SceneBuilder b;
  const int water = b.material(testing::glass(1.33f));
  const int tiles = b.material(testing::matte(Vec3(kAlbedo)));
  const int black = b.material(testing::matte(Vec3(0)));
  b.box(water, Vec3(-2, -1, -2), Vec3(2, 0, 2), false);
  b.quad(tiles, Vec3(-2, -1, 2), Vec3(4, 0, 0), Vec3(0, 0, -4));
  b.quad(black, Vec3(-2, -1, -2), Vec3(0, 1, 0), Vec3(0, 0, 4));
  b.quad(black, Vec3(2, -1, -2), Vec3(0, 0, 4), Vec3(0, 1, 0));
  b.quad(black, Vec3(-2, -1, -2), Vec3(4, 0, 0), Vec3(0, 1, 0));
  b.quad(black, Vec3(-2, -1, 2), Vec3(0, 1, 0), Vec3(4, 0, 0));
  b.environment(Radiance(1)).camera(Vec3(0, -0.2f, 0), Vec3(0, -1, 0), 1, Vec3(0, 0, 1));
  auto all = estimators(1);
  for (auto& e : all) e.settings.photonRadius = 0.05f;
  const double expected = kAlbedo * (1 - meanFresnelDielectric(1.33f)) / (1.33 * 1.33);
  testing::expectRadiance(b.build(), all, expected, {.frames = 64, .bias = 1e-3, .error = 0.03});
}

// Transmittance of a plane interface from index n1 to n2 at angle t1, Fresnel's formulas.
double transmittance(double n1, double n2, double t1) {
  const double s = n1 / n2 * std::sin(t1);
  if (s >= 1) return 0;
  const double t2 = std::asin(s), c1 = std::cos(t1), c2 = std::cos(t2);
  const double rs = (n1 * c1 - n2 * c2) / (n1 * c1 + n2 * c2);
  const double rp = (n2 * c1 - n1 * c2) / (n2 * c1 + n1 * c2);
  return 1 - (rs * rs + rp * rp) / 2;
}

// Radiance that an eye `from` sees in a direction in the xy plane, t from the vertical, upwards.
double seen(SceneBuilder b, Vec3 from, double t, Settings settings) {
  const Vec3 along(static_cast<float>(std::sin(t)), static_cast<float>(std::cos(t)), 0);
  b.camera(from, from + along, 1e-3f, Vec3(0, 0, 1));
  const Scene scene = b.build();
  const Tracer tracer(scene, Isa::automatic);
  settings.interleave = {1, 1}, settings.indirectVpls = 0, settings.photons = 0;
  return testing::render(tracer, settings, 128).grey();
}

// From under water the sky, radiance 1, is seen through Snell's window: 1 - F(t) up to the critical
// angle, nothing beyond it (total reflection shows the black bottom). Basic radiance: no factor
// n^2.
TEST(Glass, TotalReflectionStartsAtTheCriticalAngle) {
  const double n = 1.33, critical = std::asin(1 / n);
  for (const double t : {0.0, 0.3, 0.7, critical - 0.01, critical + 0.01, 1.2}) {
    SceneBuilder b;
    b.box(b.material(testing::glass(1.33f)), Vec3(-100, -10, -100), Vec3(100, 0, 100), false);
    b.box(b.material(testing::matte(Vec3(0))), Vec3(-99, -9, -99), Vec3(99, -8, 99), false);
    b.quad(b.material(testing::matte(Vec3(0), Vec3(1))), Vec3(-90, 1, -90), Vec3(180, 0, 0),
           Vec3(0, 0, 180));
    for (const auto& e : testing::estimators(4))
      EXPECT_NEAR(seen(b, Vec3(0, -1, 0), t, e.settings), transmittance(n, 1, t), 0.015)
          << e.name << " at " << t;
  }
}

// Through plane layers n1 | n2 that touch, the angle in air is the same before and after, whatever
// is between: n sin t is kept. The eye, below, sees a lamp of radiance 1 exactly where a ray
// displaced by d1 tan t1 + d2 tan t2 arrives, dimmed by the three interfaces; a second lamp, black,
// covers the rest. Reflections between the faces leave the straight path and meet black sides.
TEST(Glass, TouchingLayersBendAsOneStack) {
  const double t0 = 0.9, n1 = 1.5, n2 = 1.33, depth = 1;
  const double t1 = std::asin(std::sin(t0) / n1), t2 = std::asin(std::sin(t0) / n2);
  const double x = std::tan(t0) + depth * (std::tan(t1) + std::tan(t2)) + std::tan(t0);
  const double direct =
      transmittance(1, n1, t0) * transmittance(n1, n2, t1) * transmittance(n2, 1, t2);
  SceneBuilder b;
  b.box(b.material(testing::glass(1.5f)), Vec3(-50, 1, -50), Vec3(50, 2, 50), false);
  b.box(b.material(testing::glass(1.33f)), Vec3(-50, 2, -50), Vec3(50, 3, 50), false);
  const float w = 0.01f;
  b.quad(b.material(testing::matte(Vec3(0), Vec3(1))), Vec3(float(x) - w, 4, -w), Vec3(2 * w, 0, 0),
         Vec3(0, 0, 2 * w));
  for (const auto& e : testing::estimators(4))
    EXPECT_NEAR(seen(b, Vec3(0), t0, e.settings), direct, 0.015) << e.name;
}

// A layer of n1, 1 m thick, and one of n2, 2 m thick, overlap by half a metre. The thinner one is
// whole, so light meets 1 m of n1 and 1.5 m of n2 as if they touched, whichever comes first on the
// way or in the file.
TEST(Glass, WhereTwoOverlapTheSmallerCounts) {
  const double t0 = 0.9, n1 = 1.5, n2 = 1.2;
  const double t1 = std::asin(std::sin(t0) / n1), t2 = std::asin(std::sin(t0) / n2);
  const double x = std::tan(t0) + std::tan(t1) + 1.5 * std::tan(t2) + std::tan(t0);
  const double direct =
      transmittance(1, n1, t0) * transmittance(n1, n2, t1) * transmittance(n2, 1, t2);
  for (const bool thinBelow : {true, false})
    for (const bool thinFirst : {true, false}) {
      SceneBuilder b;
      const float thin = thinBelow ? 1.0f : 2.5f, thick = thinBelow ? 1.5f : 1.0f;
      const auto layer = [&](double n, float y, float depth) {
        b.box(b.material(testing::glass(static_cast<float>(n))), Vec3(-50, y, -50),
              Vec3(50, y + depth, 50), false);
      };
      if (thinFirst) layer(n1, thin, 1);
      layer(n2, thick, 2);
      if (!thinFirst) layer(n1, thin, 1);
      const float w = 0.01f;
      b.quad(b.material(testing::matte(Vec3(0), Vec3(1))), Vec3(float(x) - w, 4.5f, -w),
             Vec3(2 * w, 0, 0), Vec3(0, 0, 2 * w));
      for (const auto& e : testing::estimators(4))
        EXPECT_NEAR(seen(b, Vec3(0), t0, e.settings), direct, 0.015)
            << e.name << (thinBelow ? ", thin below" : ", thin above");
    }
}

}  // namespace
}  // namespace ninefold
