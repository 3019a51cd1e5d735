// Geometry as files really have it: slivers, triangles without area, things that are there twice or
// in one another, shading normals that lie, mirrored instances, the eye in the wrong place. The
// room is a furnace where it can be: walls of albedo 1/2 that emit 1 show 2, whatever stands in it
// that is of the same kind.
#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

Material furnaceWall() { return testing::matte(Vec3(0.5f), Vec3(1)); }

constexpr testing::Tolerance kTolerance{.frames = 32, .error = 0.02};

// The furnace, with its triangles cut into slivers of aspect 1 : 10^5, each there twice, and with
// points and lines (no area) among them. Readers drop what has no area; the tracer and the emitters
// must stand it all the same.
TEST(GeometryHard, SliversDuplicatesAndFlatTrianglesChangeNothing) {
  SceneBuilder b;
  b.box(b.material(furnaceWall()), Vec3(-1), Vec3(1), true);
  b.camera(Vec3(0.1f, 0.2f, 0.3f), Vec3(-1, -0.4f, -0.2f), 1.2f);
  Scene scene = b.build();
  Mesh& mesh = scene.meshes[0];
  std::vector<Triangle> cut;
  for (const Triangle& t : mesh.triangles) {
    // (a, b, c) into (a, b, m) and (a, m, c) with m on bc, 1e-5 of its length from b.
    const auto m = static_cast<uint32_t>(mesh.positions.size());
    mesh.positions.push_back(mesh.positions[t.y] +
                             1e-5f * (mesh.positions[t.z] - mesh.positions[t.y]));
    for (int twice = 0; twice < 2; ++twice) {
      cut.push_back(Triangle(t.x, t.y, m)), cut.push_back(Triangle(t.x, m, t.z));
      cut.push_back(Triangle(t.x, t.x, t.x)), cut.push_back(Triangle(t.x, t.y, t.y));
    }
  }
  mesh.triangles = cut;
  // What is there twice emits once, or the lights would be twice as many as the eye sees.
  testing::expectRadiance(scene, testing::estimators(), 2, kTolerance);
}

// The furnace of six squares, each with one shading normal that leans by `tilt` from the geometric
// one.
Scene leaningFurnace(float tilt) {
  SceneBuilder b;
  const int wall = b.material(furnaceWall());
  b.quad(wall, Vec3(-1, -1, 1), Vec3(2, 0, 0), Vec3(0, 0, -2));
  b.quad(wall, Vec3(-1, 1, -1), Vec3(2, 0, 0), Vec3(0, 0, 2));
  b.quad(wall, Vec3(-1, -1, -1), Vec3(2, 0, 0), Vec3(0, 2, 0));
  b.quad(wall, Vec3(1, -1, 1), Vec3(-2, 0, 0), Vec3(0, 2, 0));
  b.quad(wall, Vec3(-1, -1, 1), Vec3(0, 0, -2), Vec3(0, 2, 0));
  b.quad(wall, Vec3(1, -1, -1), Vec3(0, 0, 2), Vec3(0, 2, 0));
  b.camera(Vec3(0.1f, 0.2f, 0.3f), Vec3(-1, -0.4f, -0.2f), 1.2f);
  Scene scene = b.build();
  for (Mesh& mesh : scene.meshes) {
    const Vec3 u = glm::normalize(mesh.positions[1] - mesh.positions[0]);
    const Vec3 v = glm::normalize(mesh.positions[3] - mesh.positions[0]);
    const Vec3 n = std::cos(tilt) * glm::cross(u, v) + std::sin(tilt) * u;
    mesh.normals.assign(mesh.positions.size(), n);
  }
  return scene;
}

// Light comes from directions above the geometric plane and counts with the cosine to the shading
// normal: of a hemisphere of radiance L a normal that leans by t takes pi L (1 + cos t)/2. So each
// bounce keeps a (1 + cos t)/2, in every estimator: particles pay for it on arrival.
TEST(GeometryHard, LeaningShadingNormalsLoseTheirShare) {
  for (const float tilt : {0.5f, 1.0f})
    for (const int pathLength : {1, 2, 0}) {
      const double kept = 0.5 * (1 + std::cos(static_cast<double>(tilt))) / 2;
      auto all = testing::estimators(8, pathLength);
      testing::expectRadiance(
          leaningFurnace(tilt), all, testing::furnaceRadiance(kept, pathLength), kTolerance,
          "tilt " + testing::number(tilt) + ", path length " + testing::number(pathLength));
    }
}

// Normals that point into the wall are turned: that is what a model with flipped normals means.
TEST(GeometryHard, ShadingNormalsThatPointBackwardsAreTurned) {
  testing::expectRadiance(leaningFurnace(kPi), testing::estimators(), 2, kTolerance);
}

// Mirrored instances keep their fronts: emission, glass and all.
TEST(GeometryHard, MirroredInstancesAreInvisibleInAFurnace) {
  SceneBuilder b;
  b.box(b.material(furnaceWall()), Vec3(-1), Vec3(1), true);
  b.sphere(b.material(testing::glass(1.5f)), Vec3(-0.3f, -0.3f, 0), 0.4f, 32);
  b.camera(Vec3(0, 0.1f, 0.95f), Vec3(0.05f, -0.3f, -0.3f), 1.0f);
  Scene scene = b.build();
  for (Instance& i : scene.instances) i.toWorld[0][0] = -1;
  testing::expectRadiance(scene, testing::estimators(), 2,
                          {.frames = 32, .bias = 2e-3, .error = 0.02});
}

// A lamp of radiance 1 in the very plane of the ceiling, albedo 0 both: the ceiling hides nothing
// of it. Under its middle, at depth h, a square of side 2a gives (Lambert's formula for four edges)
//   E = 4 a/sqrt(a^2+h^2) atan(a/sqrt(a^2+h^2)),  L = albedo E/pi.
TEST(GeometryHard, LampsInThePlaneOfTheCeilingLightTheFloor) {
  SceneBuilder b;
  const int floor = b.material(testing::matte(Vec3(0.5f)));
  const int black = b.material(testing::matte(Vec3(0)));
  const int lamp = b.material(testing::matte(Vec3(0), Vec3(1)));
  b.quad(floor, Vec3(-2, 0, 2), Vec3(4, 0, 0), Vec3(0, 0, -4));
  b.quad(black, Vec3(-2, 1, -2), Vec3(4, 0, 0), Vec3(0, 0, 4));
  b.quad(lamp, Vec3(-0.5f, 1, -0.5f), Vec3(1, 0, 0), Vec3(0, 0, 1));
  SceneBuilder seen = b;
  b.camera(Vec3(0.3f, 0.5f, 0), Vec3(0), 0.01f);
  const double side = 0.5 / std::hypot(0.5, 1.0);
  const double expected = 0.5 / static_cast<double>(kPi) * 4 * side * std::atan(side);
  testing::expectRadiance(b.build(), testing::estimators(), expected, {.bias = 1e-3});
  seen.camera(Vec3(0, 0.5f, 0), Vec3(0, 1, 0), 0.8f, Vec3(0, 0, 1));
  testing::expectRadiance(seen.build(), testing::estimators(), 1, {.frames = 2});
}

// The eye in a wall, that is inside of an opaque block: it sees the block from within, unlit.
TEST(GeometryHard, EyesInAWallSeeNothing) {
  SceneBuilder b;
  b.box(b.material(furnaceWall()), Vec3(-1), Vec3(1), true);
  b.box(b.material(testing::matte(Vec3(0.5f))), Vec3(-0.3f), Vec3(0.3f), false);
  b.camera(Vec3(0.1f, 0, 0), Vec3(1, 0.2f, 0), 1.5f);
  const Scene scene = b.build();
  const Tracer tracer(scene, Isa::automatic);
  for (const auto& e : testing::estimators())
    for (const Vec3& p : testing::render(tracer, e.settings, 8).pixels) EXPECT_EQ(p, Vec3(0));
}

// The eye exactly in the floor's plane, on it, looking up: the sky, and nothing of the floor. A
// little above it, within rounding, looking down: nothing but the floor.
TEST(GeometryHard, EyesOnASurfaceAreOnItsSide) {
  for (const float y : {0.0f, 0.3f}) {
    SceneBuilder up;
    up.quad(up.material(testing::matte(Vec3(0))), Vec3(-1, y, 1), Vec3(2, 0, 0), Vec3(0, 0, -2));
    up.environment(Radiance(1));
    SceneBuilder down = up;
    up.camera(Vec3(0.2f, y, 0.1f), Vec3(0.4f, y + 1, 0.3f), 1.5f);
    testing::expectRadiance(up.build(), testing::estimators(), 1, {.frames = 4});
    down.camera(Vec3(0.2f, std::nextafter(y, 1.0f), 0.1f), Vec3(0.4f, y - 1, 0.3f), 1.5f);
    const Scene scene = down.build();
    const Tracer tracer(scene, Isa::automatic);
    for (const auto& e : testing::estimators())
      for (const Vec3& p : testing::render(tracer, e.settings, 4).pixels)
        EXPECT_EQ(p, Vec3(0)) << e.name;
  }
}

}  // namespace
}  // namespace ninefold
