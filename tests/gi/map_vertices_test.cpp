// The vertices of a finer mesh. A k x k grid of quads whose triangles are cut into n x n has
//
//   (k n + 1)^2 vertices
//
// if it is smooth, whether or not its triangles share theirs, and a box of which no two faces share
// any has 6 (n + 1)^2. Weights of the three vertices around a point give the point.
#include <gtest/gtest.h>

#include <set>

#include "common/gi/photon_map/map_vertices.h"
#include "common/sampling/hash.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

struct World {
  World(Scene s, int levels) : scene(std::move(s)), tracer(scene, Isa::automatic) {
    Settings settings;
    settings.mapEstimate = MapEstimate::vertices, settings.mapSubdivision = levels;
    transport = std::make_unique<Transport>(tracer, settings);
    vertices = std::make_unique<MapVertices>(*transport);
  }
  Scene scene;
  Tracer tracer;
  std::unique_ptr<Transport> transport;
  std::unique_ptr<MapVertices> vertices;
};

float unitOf(uint64_t i, uint64_t use) {
  return static_cast<float>(hashWords(i, use) >> 40) * 0x1p-24f;
}

// z = height(x), k x k quads of side 1/k, each triangle with three vertices of its own.
Scene sheet(int k, float (*height)(float), float (*slope)(float)) {
  Mesh mesh;
  const auto add = [&](int i, int j, bool left) {
    const float x = static_cast<float>(i) / static_cast<float>(k);
    mesh.triangles.back()[static_cast<int>(mesh.positions.size() % 3)] =
        static_cast<uint32_t>(mesh.positions.size());
    mesh.positions.push_back(Vec3(x, static_cast<float>(j) / static_cast<float>(k), height(x)));
    const float s = slope(left ? x - 1e-4f : x + 1e-4f);
    mesh.normals.push_back(glm::normalize(Vec3(-s, 0, 1)));
  };
  for (int i = 0; i < k; ++i)
    for (int j = 0; j < k; ++j) {
      mesh.triangles.emplace_back();
      add(i, j, false), add(i + 1, j, true), add(i + 1, j + 1, true);
      mesh.triangles.emplace_back();
      add(i, j, false), add(i + 1, j + 1, true), add(i, j + 1, false);
    }
  Scene scene;
  scene.materials = {testing::matte(Vec3(0.5f))};
  scene.meshes = {std::move(mesh)};
  scene.instances = {Instance{}};
  scene.cameras = {Camera{}};
  for (const Vec3& p : scene.meshes[0].positions) scene.bounds.add(p);
  return scene;
}

constexpr int kQuads = 4;
Scene wave() {
  return sheet(
      kQuads, [](float x) { return 0.05f * std::sin(6 * x); },
      [](float x) { return 0.3f * std::cos(6 * x); });
}
// Two planes that meet in a right angle at x = 1/2.
Scene roof() {
  return sheet(
      kQuads, [](float x) { return -std::abs(x - 0.5f); },
      [](float x) { return x < 0.5f ? 1.0f : -1.0f; });
}
Scene boxes() {
  SceneBuilder b;
  const int wall = b.material(testing::matte(Vec3(0.5f)));
  b.box(wall, Vec3(-1), Vec3(1), true).box(wall, Vec3(-0.3f), Vec3(0.2f), false);
  Scene scene = b.build();
  scene.instances[1].toWorld[3] = DVec4(0.1, 0.2, 0.3, 1);
  scene.instances[1].toWorld[0][0] = -1;  // mirrored
  return scene;
}

TEST(MapVertices, AreSharedAcrossSmoothSurfacesAndNeverAcrossEdges) {
  for (int levels = 0; levels <= 6; ++levels) {
    const uint32_t n = 1u << levels, row = kQuads * n + 1;
    EXPECT_EQ(World(wave(), levels).vertices->count(), row * row);
    EXPECT_EQ(World(roof(), levels).vertices->count(), row * row + row);
    EXPECT_EQ(World(boxes(), levels).vertices->count(), 2 * 6 * (n + 1) * (n + 1));
  }
}

// The roof of shading normals that agree across its ridge.
TEST(MapVertices, AreNotSharedWhereOnlyShadingIsSmooth) {
  Scene scene = roof();
  Mesh mesh = scene.meshes[0];
  for (Vec3& n : mesh.normals) n = Vec3(0, 0, 1);
  scene.meshes = {std::move(mesh)};
  EXPECT_EQ(World(scene, 1).vertices->count(), 9u * 9 + 9);
}

// Each name is that of one place, and all names are.
TEST(MapVertices, HaveOneNameEach) {
  for (const auto& make : {wave, roof, boxes})
    for (int levels : {0, 1, 2, 3, 5}) {
      const World w(make(), levels);
      const uint32_t n = 1u << levels;
      std::set<uint32_t> names;
      for (uint32_t object = 0; object < w.scene.instances.size(); ++object) {
        const Mesh& mesh = w.scene.meshes[static_cast<size_t>(w.scene.instances[object].mesh)];
        for (uint32_t t = 0; t < mesh.triangles.size(); ++t)
          for (uint32_t i = 0; i <= n; ++i)
            for (uint32_t j = 0; i + j <= n; ++j) {
              const float u = static_cast<float>(i) / static_cast<float>(n);
              const float v = static_cast<float>(j) / static_cast<float>(n);
              const auto around = w.vertices->around(object, t, u, v, false);
              const auto most =
                  static_cast<size_t>(std::max_element(around.weight.begin(), around.weight.end()) -
                                      around.weight.begin());
              EXPECT_EQ(around.weight[most], 1.0f);
              const Receiver r = w.vertices->receiver(around.entry[most]);
              const Tracer::Corners at = w.tracer.corners(object, t);
              const Vec3 x = at.a + u * (at.b - at.a) + v * (at.c - at.a);
              EXPECT_LT(glm::length(r.position - x), 1e-6f);
              EXPECT_EQ(r.pixel, around.entry[most]);
              EXPECT_EQ(r.object, object);
              EXPECT_GT(glm::dot(r.ng, w.tracer.frontNormal(object, t)), 0.5f);
              names.insert(around.entry[most]);
            }
      }
      EXPECT_EQ(names.size(), w.vertices->count());
      EXPECT_EQ(*names.rbegin(), w.vertices->count() - 1);
    }
}

TEST(MapVertices, AroundAPointGiveThePoint) {
  for (int levels = 0; levels <= 6; ++levels) {
    const World w(wave(), levels);
    const float most = 0.37f / static_cast<float>(1u << levels);  // of a small triangle's side
    for (uint64_t k = 0; k < 2000; ++k) {
      const auto triangle =
          static_cast<uint32_t>(hashWords(k, 1) % w.scene.meshes[0].triangles.size());
      float u = unitOf(k, 2), v = unitOf(k, 3);
      if (k % 7 == 0) u = 0;
      if (k % 11 == 0) v = 1 - u;
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const auto around = w.vertices->around(0, triangle, u, v, k % 2 == 1);
      const Tracer::Corners at = w.tracer.corners(0, triangle);
      const Vec3 x = at.a + u * (at.b - at.a) + v * (at.c - at.a);
      Vec3 mean(0);
      float sum = 0;
      for (size_t i = 0; i < 3; ++i) {
        const Receiver r = w.vertices->receiver(around.entry[i]);
        EXPECT_GE(around.weight[i], 0.0f);
        EXPECT_TRUE(around.weight[i] == 0 || glm::length(r.position - x) < most);
        EXPECT_EQ(r.ng.z > 0, k % 2 == 0);
        mean += around.weight[i] * r.position, sum += around.weight[i];
      }
      EXPECT_NEAR(sum, 1, 1e-6f);
      EXPECT_LT(glm::length(mean - x), 2e-6f);
    }
  }
}

// What one instance does leaves the names of all as they are.
TEST(MapVertices, KeepTheirNamesWhenThingsMove) {
  Scene moved = boxes();
  moved.instances[0].toWorld[3].y += 0.25;
  const World before(boxes(), 2), after(moved, 2);
  ASSERT_EQ(before.vertices->count(), after.vertices->count());
  for (uint32_t entry = 0; entry < before.vertices->entries(); ++entry) {
    const Receiver a = before.vertices->receiver(entry), b = after.vertices->receiver(entry);
    EXPECT_EQ(a.triangle, b.triangle);
    EXPECT_LT(glm::length(b.position - a.position - Vec3(0, a.object == 0 ? 0.25f : 0, 0)), 1e-6f);
  }
}

}  // namespace
}  // namespace ninefold
