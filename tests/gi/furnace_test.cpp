// The white furnace: in a closed room whose walls have albedo a and emit radiance 1, every point
// sees
//     L = 1 + a + a^2 + ... = 1/(1-a)      and, with at most n diffuse vertices a path, the partial
//     sum L_n = 1 + a + ... + a^n.
#include <gtest/gtest.h>

#include "tests/gi/make_scene.h"
#include "tests/gi/render.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

Scene furnace(float albedo) {
  SceneBuilder b;
  const int wall = b.material(testing::matte(Vec3(albedo), Vec3(1)));
  b.box(wall, Vec3(-1), Vec3(1), true).camera(Vec3(0.1f, 0.2f, 0.3f), Vec3(-1, -0.4f, -0.2f), 1.2f);
  return b.build();
}

double partialSum(double a, int n) {
  double sum = 0;
  for (int i = 0; i <= n; ++i) sum += std::pow(a, i);
  return sum;
}

TEST(Furnace, PathTracerMeetsTheGeometricSeries) {
  for (const float a : {0.0f, 0.5f, 0.8f}) {
    const Scene scene = furnace(a);
    const Tracer tracer(scene, Isa::automatic);
    const auto image = testing::render(tracer, testing::small(Method::pathTrace), 16);
    EXPECT_NEAR(image.grey(), 1 / (1 - static_cast<double>(a)), 4 * image.error() + 1e-5)
        << "albedo " << a;
  }
}

TEST(Furnace, PathTracerStopsAtThePathLength) {
  const Scene scene = furnace(0.5f);
  const Tracer tracer(scene, Isa::automatic);
  for (const int n : {1, 2, 4}) {
    Settings s = testing::small(Method::pathTrace);
    s.pathLength = n;
    const auto image = testing::render(tracer, s, 16);
    EXPECT_NEAR(image.grey(), partialSum(0.5, n), 4 * image.error() + 1e-5) << "path length " << n;
  }
}

// With a bound far beyond what this camera's pixels meet, the VPLs have no bias; corners make the
// variance large, so the camera looks at the middle of a wall.
TEST(Furnace, VirtualPointLightsMeetTheGeometricSeries) {
  for (const float a : {0.0f, 0.5f, 0.8f}) {
    SceneBuilder b;
    const int wall = b.material(testing::matte(Vec3(a), Vec3(1)));
    b.box(wall, Vec3(-1), Vec3(1), true).camera(Vec3(0, 0, 0.9f), Vec3(0, 0, -1), 0.3f);
    const Scene scene = b.build();
    const Tracer tracer(scene, Isa::automatic);
    Settings s = testing::small(Method::instantRadiosity);
    s.bound = 1e5f;
    s.directVpls = 64, s.indirectVpls = 256;
    const auto image = testing::render(tracer, s, 24);
    EXPECT_NEAR(image.grey(), 1 / (1 - static_cast<double>(a)), 4 * image.error() + 1e-5)
        << "albedo " << a;
    EXPECT_LT(image.error(), 0.02 * image.grey());
  }
}

TEST(Furnace, VirtualPointLightsStopAtThePathLength) {
  SceneBuilder b;
  const int wall = b.material(testing::matte(Vec3(0.5f), Vec3(1)));
  b.box(wall, Vec3(-1), Vec3(1), true).camera(Vec3(0, 0, 0.9f), Vec3(0, 0, -1), 0.3f);
  const Scene scene = b.build();
  const Tracer tracer(scene, Isa::automatic);
  for (const int n : {1, 2, 3}) {
    Settings s = testing::small(Method::instantRadiosity);
    s.bound = 1e5f, s.pathLength = n;
    s.directVpls = 64, s.indirectVpls = 256;
    const auto image = testing::render(tracer, s, 24);
    EXPECT_NEAR(image.grey(), partialSum(0.5, n), 4 * image.error() + 1e-5) << "path length " << n;
  }
}

// Without light straight from the lamps the term of one bounce is missing, and no other:
// L = L_e (1 + a^2 + a^3 + ...). In the corners, which the picture shows, the compensation brings
// most of it, from surfaces that lamps light.
TEST(Furnace, WithoutDirectLightTheTermOfOneBounceIsMissing) {
  const float a = 0.5f;
  const Scene scene = furnace(a);
  const Tracer tracer(scene, Isa::automatic);
  for (const Method method : {Method::pathTrace, Method::instantRadiosity}) {
    Settings s = testing::small(method);
    s.directVpls = 0, s.bound = 3;
    const auto image = testing::render(tracer, s, 64);
    EXPECT_NEAR(image.grey(), 1 / (1 - double{a}) - double{a}, 4 * image.error() + 1e-5)
        << "method " << static_cast<int>(method);
    EXPECT_LT(image.error(), 0.01 * image.grey());
  }
}

// Basic radiance: a clear dielectric in a furnace changes nothing, seen from outside or from
// inside.
TEST(Furnace, GlassBallIsInvisible) {
  for (const bool inside : {false, true}) {
    for (const Method method : {Method::pathTrace, Method::instantRadiosity}) {
      SceneBuilder b;
      const int wall = b.material(testing::matte(Vec3(0), Vec3(1)));
      const int clear = b.material(testing::glass(1.5f));
      b.box(wall, Vec3(-1), Vec3(1), true).sphere(clear, Vec3(0), 0.5f, 64);
      b.camera(inside ? Vec3(0.1f, 0, 0.2f) : Vec3(0, 0, 0.95f), Vec3(0.05f, 0.02f, -0.3f), 1.0f);
      const Scene scene = b.build();
      const Tracer tracer(scene, Isa::automatic);
      Settings s = testing::small(method);
      s.specularDepth = 128;
      const auto image = testing::render(tracer, s, 32);
      EXPECT_NEAR(image.grey(), 1.0, 4 * image.error() + 2e-3)
          << (inside ? "inside" : "outside") << ", method " << static_cast<int>(method);
    }
  }
}

}  // namespace
}  // namespace ninefold
