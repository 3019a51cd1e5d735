// Where the lines of an intersection field meet a scene, held against Embree's hits along them.
#include "common/gi/intersection_field/line_field.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "common/sampling/sampler.h"
#include "common/tracing/tracer.h"
#include "tests/gi/line_rays.h"
#include "tests/gi/make_scene.h"
#include "tests/gi/render.h"
#include "tests/seeds.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

// A room with a ball, and a box that is turned, moved and mirrored.
Scene roomOf(DVec3 boxAt = DVec3(0.3, -0.6, 0.2)) {
  SceneBuilder b;
  const int grey = b.material(testing::matte(Vec3(0.5f)));
  b.box(grey, Vec3(-1, -1, -1.3f), Vec3(1, 1.1f, 1), true);
  b.sphere(grey, Vec3(-0.3f, 0.1f, 0.2f), 0.4f, 10);
  b.box(grey, Vec3(-0.2f), Vec3(0.2f, 0.3f, 0.1f), false);
  Scene scene = b.build();
  DMat4& m = scene.instances[2].toWorld;
  m[0] = DVec4(-0.6, 0, 0.8, 0), m[2] = DVec4(0.8, 0, 0.6, 0), m[3] = DVec4(boxAt, 1);
  return scene;
}

TEST(LineField, HasTheHitsThatRaysFind) {
  const Scene scene = roomOf();
  const Tracer tracer(scene, Isa::automatic);
  const LineField field(LineGrid(scene.bounds, 9, 16), scene, nullptr);
  const testing::LineCounts counts = testing::heldAgainstRays(field, tracer, 7);
  EXPECT_GT(counts.all, 10000u);
  EXPECT_LT(counts.unlike, counts.all / 500) << "of " << counts.all;
}

// A closed surface is crossed in and out by turns, by every line, whatever edges it passes: no line
// slips between triangles, and none meets two that share an edge.
TEST(LineField, HasNoGapsAndNoDoubles) {
  const Scene scene = roomOf();
  const Tracer tracer(scene, Isa::automatic);
  const LineField field(LineGrid(scene.bounds, 13, 24), scene, nullptr);
  const LineGrid& grid = field.grid();
  std::vector<LineHit> hits;
  for (uint32_t number = 0; number < grid.lines(); ++number) {
    const GridLine line = grid.lineOf(number);
    field.hitsOf(line, hits);
    std::map<uint32_t, int> inside;  // by instance: in minus out
    std::map<uint32_t, int> crossed;
    for (const LineHit& hit : hits) {
      const float cosine =
          glm::dot(tracer.frontNormal(hit.instance, hit.triangle), grid.directionOf(line));
      inside[hit.instance] += cosine > 0 ? 1 : -1;
      ++crossed[hit.instance];
    }
    for (const auto& [instance, count] : crossed) ASSERT_EQ(count % 2, 0) << number;
    for (const auto& [instance, sum] : inside) ASSERT_EQ(sum, 0) << number;
  }
}

// Each line of each run is what the triangle's plane says, and a run gives back all of its lines:
// worked out one by one from the segment that it is made of.
TEST(LineField, RunsHoldWhatTheyAreMadeOf) {
  const LineGrid grid(roomOf().bounds, 9, 16);
  std::array<LineRun, 2 * LineGrid::kMostDirections> runs;
  size_t lines = 0;
  for (const uint64_t seed : seedsFrom(1, 100)) {
    const Repeatable repeatable(seed);
    std::array<Vec3, 3> corners;
    for (size_t c = 0; c < 3; ++c)
      for (int x = 0; x < 3; ++x)
        corners[c][x] =
            2 * unitFloat(static_cast<uint32_t>(hashWords(seed, c, static_cast<uint64_t>(x)))) - 1;
    const Vec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    for (int i = 0; i < grid.directions(); ++i) {
      const SlicedTriangle triangle(grid, 0, i, corners);
      for (int j = triangle.first(grid); j < triangle.end(grid); ++j) {
        const Segment s = segmentOf(triangle, j);
        runsOf(grid, 0, s, 7, runs);
        for (int k = 0; k < 2 * grid.directions(); ++k) {
          const LineRun& run = runs[static_cast<size_t>(k)];
          const LineGrid::Places& d = grid.placesOfD(0, k);
          const float c = grid.slope(k);
          const auto place = [&](Vec2 p) {
            return (grid.isSteep(k) ? p.x - c * p.y : p.y - c * p.x) * d.scale + d.offset;
          };
          const float low = std::min(place(s.p), place(s.q)),
                      high = std::max(place(s.p), place(s.q));
          for (int m = 0; m < grid.distances(); ++m) {
            const auto at = static_cast<float>(m);
            ASSERT_EQ(run.has(m), low <= at && at < high);
            if (!run.has(m) || high - low < 0.05f) continue;
            const Vec3 p = grid.toFamily(0, grid.pointAt({0, i, j, k, m}, run.at(m)));
            const float off = glm::dot(p - corners[0], normal) / glm::length(normal);
            ASSERT_NEAR(off, 0, 2e-4f);
            ++lines;
          }
        }
      }
    }
  }
  EXPECT_GT(lines, 10000u);
}

TEST(LineField, TellsTheNextHitOnALine) {
  const Scene scene = roomOf();
  const LineField field(LineGrid(scene.bounds, 9, 16), scene, nullptr);
  std::vector<LineHit> hits;
  for (uint32_t number = 0; number < field.grid().lines(); number += 11) {
    const GridLine line = field.grid().lineOf(number);
    field.hitsOf(line, hits);
    const float apart = 2 * field.grid().rounding();
    for (size_t k = 0; k + 1 < hits.size(); ++k) {
      if (hits[k + 1].t - hits[k].t < apart) continue;
      ASSERT_EQ(field.next(line, hits[k].t, true)->t, hits[k + 1].t);
      ASSERT_EQ(field.next(line, hits[k + 1].t, false)->t, hits[k].t);
    }
    if (hits.empty()) continue;
    EXPECT_FALSE(field.next(line, hits.back().t, true));
    EXPECT_FALSE(field.next(line, hits.front().t, false));
  }
}

// After an edit: what moved is made again, the rest is shared, and all is as made afresh.
TEST(LineField, IsAfterAnEditWhatItIsAfresh) {
  const Scene before = roomOf(), after = [&] {
    Scene scene = before;
    scene.instances[2].toWorld[3] = DVec4(-0.4, 0.5, -0.3, 1);
    return scene;
  }();
  const LineGrid grid(before.bounds, 9, 16);
  const LineField first(grid, before, nullptr);
  const LineField edited(grid, after, &first), fresh(grid, after, nullptr);
  EXPECT_TRUE(edited.isShared(first, 0));
  EXPECT_TRUE(edited.isShared(first, 1));
  EXPECT_FALSE(edited.isShared(first, 2));
  std::vector<LineHit> a, b;
  size_t moved = 0;
  for (uint32_t number = 0; number < fresh.grid().lines(); ++number) {
    const GridLine line = fresh.grid().lineOf(number);
    edited.hitsOf(line, a), fresh.hitsOf(line, b);
    ASSERT_EQ(a, b);
    for (const LineHit& hit : a) moved += hit.instance == 2 ? 1 : 0;
  }
  EXPECT_GT(moved, 1000u);
}

TEST(LineField, PassesHolesAndDoubledTriangles) {
  SceneBuilder b;
  Material masked = testing::matte(Vec3(0.5f));
  masked.alphaMode = AlphaMode::mask, masked.opacity = 0.2f;
  b.quad(b.material(masked), Vec3(-1, -1, 0), Vec3(2, 0, 0), Vec3(0, 2, 0));
  b.quad(b.material(testing::matte(Vec3(0.5f))), Vec3(-1, -1, 0.5f), Vec3(2, 0, 0), Vec3(0, 2, 0));
  Scene scene = b.build();
  Mesh& mesh = scene.meshes[1];
  mesh.triangles.push_back(mesh.triangles[0]), mesh.triangles.push_back(mesh.triangles[1]);
  const LineField field(LineGrid(scene.bounds, 9, 16), scene, nullptr);
  std::vector<LineHit> hits;
  size_t all = 0;
  for (uint32_t number = 0; number < field.grid().lines(); ++number) {
    field.hitsOf(field.grid().lineOf(number), hits);
    ASSERT_LE(hits.size(), 1u);
    for (const LineHit& hit : hits) {
      ASSERT_EQ(hit.instance, 1u);
      ++all;
    }
  }
  EXPECT_GT(all, 1000u);
}

}  // namespace
}  // namespace ninefold
