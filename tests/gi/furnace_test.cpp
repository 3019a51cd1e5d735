// The white furnace: in a closed room whose walls have albedo a and emit radiance 1, every point
// sees
//
//   L = 1 + a + a^2 + ... = 1/(1-a)      without limit
//   L_n = 1 + a + ... + a^n              with at most n diffuse vertices a path
#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

SceneBuilder furnace(float albedo) {
  SceneBuilder b;
  b.box(b.material(testing::matte(Vec3(albedo), Vec3(1))), Vec3(-1), Vec3(1), true);
  return b;
}

// Sees a corner and edges of the room.
Scene seenAskew(float albedo) {
  return furnace(albedo).camera(Vec3(0.1f, 0.2f, 0.3f), Vec3(-1, -0.4f, -0.2f), 1.2f).build();
}

// Sees the middle of a wall.
Scene seenStraight(float albedo) {
  return furnace(albedo).camera(Vec3(0, 0, 0.9f), Vec3(0, 0, -1), 0.3f).build();
}

// With a bound far beyond what pixels in the middle of a wall meet, VPLs carry all light there; in
// corners their variance would be large, and the usual bound leaves some to compensation.
void expectRadiance(float albedo, int pathLength, double expected) {
  const std::string what =
      "albedo " + testing::number(double(albedo)) + ", path length " + testing::number(pathLength);
  for (const bool straight : {false, true}) {
    auto all = testing::estimators(12, pathLength);
    all.push_back(testing::mapAtVertices(12, pathLength));
    for (auto& e : all) {
      e.settings.directVpls = 64, e.settings.indirectVpls = 256;
      if (straight) e.settings.bound = 1e5f;
    }
    testing::expectRadiance(straight ? seenStraight(albedo) : seenAskew(albedo), all, expected,
                            {.frames = 24, .bias = 1e-5, .error = 0.02},
                            what + (straight ? ", straight" : ", askew"));
  }
}

TEST(Furnace, MeetsTheGeometricSeries) {
  for (const float a : {0.0f, 0.5f, 0.8f})
    expectRadiance(a, 0, testing::furnaceRadiance(double(a)));
}

TEST(Furnace, StopsAtThePathLength) {
  for (const int n : {1, 2, 3, 4}) expectRadiance(0.5f, n, testing::furnaceRadiance(0.5, n));
}

// Without light straight from the lamps the term of one bounce is missing, and no other:
// L = L_e (1 + a^2 + a^3 + ...). In the corners, which the picture shows, the compensation brings
// most of it, from surfaces that lamps light.
TEST(Furnace, WithoutDirectLightTheTermOfOneBounceIsMissing) {
  const float a = 0.5f;
  const Scene scene = seenAskew(a);
  const Tracer tracer(scene, Isa::automatic);
  for (const MethodFacts& facts : allMethods()) {
    if (facts.isChoice) continue;
    Settings s = testing::small(facts.method);
    s.directVpls = 0, s.bound = 3;
    const auto image = testing::render(tracer, s, 64);
    EXPECT_NEAR(image.grey(), 1 / (1 - double{a}) - double{a}, 4 * image.error() + 1e-5)
        << facts.name;
    EXPECT_LT(image.error(), 0.01 * image.grey()) << facts.name;
  }
}

// Basic radiance: a clear dielectric in a furnace changes nothing, seen from outside or from
// inside.
TEST(Furnace, GlassBallIsInvisible) {
  for (const bool inside : {false, true}) {
    SceneBuilder b = furnace(0);
    b.sphere(b.material(testing::glass(1.5f)), Vec3(0), 0.5f, 64);
    b.camera(inside ? Vec3(0.1f, 0, 0.2f) : Vec3(0, 0, 0.95f), Vec3(0.05f, 0.02f, -0.3f), 1.0f);
    testing::expectRadiance(b.build(), testing::estimators(12), 1, {.frames = 32, .bias = 2e-3},
                            inside ? "inside" : "outside");
  }
}

}  // namespace
}  // namespace ninefold
