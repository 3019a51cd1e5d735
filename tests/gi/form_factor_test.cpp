// Form factors: a plate, or sphere, of radiance 1 and flux Phi = pi A1 sends F12 Phi to a second
// one. What the second, of albedo a, then shows on average after one diffuse vertex is
//
//   L = a/pi * F12 pi A1/A2 = a F12 A1/A2
//
// The eye looks at it straight on, so that equal pixels are equal areas.
#include "tests/gi/closed_form.h"
#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

constexpr double kAlbedo = 0.5;

// A unit square [0, 1]^2 of the plane z = 0, front towards +z, that the whole picture shows.
SceneBuilder receiver() {
  SceneBuilder b;
  b.quad(b.material(testing::matte(Vec3(0.5f))), Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0));
  b.camera(Vec3(0.5f, 0.5f, 0.05f), Vec3(0.5f, 0.5f, 0), 2 * std::atan(10.0f));
  return b;
}

TEST(FormFactor, OppositeSquares) {
  for (const float d : {0.1f, 1.0f, 3.0f}) {
    SceneBuilder b = receiver();
    b.quad(b.material(testing::matte(Vec3(0), Vec3(1))), Vec3(0, 0, d), Vec3(0, 1, 0),
           Vec3(1, 0, 0));
    testing::expectRadiance(b.build(), testing::estimators(8, 1),
                            kAlbedo * testing::oppositeSquares(static_cast<double>(d)), {},
                            "distance " + testing::number(d));
  }
}

// Near the common edge G grows without bound: there the light comes back by compensation.
TEST(FormFactor, SquaresAtARightAngleWithACommonEdge) {
  SceneBuilder b = receiver();
  b.quad(b.material(testing::matte(Vec3(0), Vec3(1))), Vec3(0), Vec3(0, 1, 0), Vec3(0, 0, 1));
  testing::expectRadiance(b.build(), testing::estimators(8, 1),
                          kAlbedo * testing::squaresWithACommonEdge(), {.frames = 192});
}

// VPLs without compensation: what the bound takes away near the edge is missing, and only that.
TEST(FormFactor, TheBoundAloneOnlyTakesAway) {
  SceneBuilder b = receiver();
  b.quad(b.material(testing::matte(Vec3(0), Vec3(1))), Vec3(0), Vec3(0, 1, 0), Vec3(0, 0, 1));
  Settings s = testing::radiosity(8, 1).settings;
  s.compensate = false;
  const Scene scene = b.build();
  const Tracer tracer(scene, Isa::automatic);
  const double whole = kAlbedo * testing::squaresWithACommonEdge();
  s.bound = 30;
  const auto low = testing::render(tracer, s, 256);
  EXPECT_LT(low.grey() + 5 * low.error(), whole);
  EXPECT_GT(low.grey(), 0.7 * whole);
  s.bound = 1e6f;
  testing::expectMean(testing::render(tracer, s, 256), whole, {.bias = 5e-3, .error = 0.02}, "");
}

// A sphere of radius r over a disk of radius R; disk and sphere are polyhedra with many faces.
TEST(FormFactor, DiskFromASphere) {
  const double r = 0.2, R = 1, h = 0.5;
  constexpr int kSides = 128;
  SceneBuilder b = receiver();
  b.sphere(b.material(testing::matte(Vec3(0), Vec3(1))), Vec3(0, 0, 0.5f), 0.2f, 64);
  // The picture shows [-1, 1]^2, of which the disk fills pi/4.
  b.camera(Vec3(0, 0, 0.1f), Vec3(0), 2 * std::atan(10.0f));
  Scene scene = b.build();
  Mesh& disk = scene.meshes[0];
  disk.positions = {Vec3(0)}, disk.triangles.clear();
  for (uint32_t i = 0; i < kSides; ++i) {
    const double angle = 2 * testing::kExactPi * i / kSides;
    disk.positions.emplace_back(std::cos(angle), std::sin(angle), 0);
    disk.triangles.emplace_back(0, i + 1, (i + 1) % kSides + 1);
  }
  const double factor = testing::sphereToDisk(h, R);
  const double expected = kAlbedo * factor * 4 * r * r / (R * R) * testing::kExactPi / 4;
  testing::expectRadiance(scene, testing::estimators(8, 1), expected,
                          {.frames = 256, .bias = 2e-3});
}

}  // namespace
}  // namespace ninefold
