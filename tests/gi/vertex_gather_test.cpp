// Light at the vertices of a finer mesh, held against what single points find in the same pool.
#include <gtest/gtest.h>

#include <numeric>
#include <thread>

#include "common/gi/photon_map/vertex_gather.h"
#include "common/gi/whole_state.h"
#include "tests/gi/make_scene.h"
#include "tests/gi/render.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

// A floor from -2 to 2 in x and z, the front upwards.
SceneBuilder floorOf() {
  SceneBuilder b;
  b.quad(b.material(testing::matte(Vec3(0.5f))), Vec3(-2, 0, 2), Vec3(4, 0, 0), Vec3(0, 0, -4));
  return b;
}

struct World {
  World(Scene made, Settings s, int levels)
      : scene(std::move(made)), tracer(scene, Isa::automatic) {
    s.mapEstimate = MapEstimate::vertices, s.mapSubdivision = levels;
    transport = std::make_unique<Transport>(tracer, s);
    vertices = std::make_unique<MapVertices>(*transport);
  }
  // Where a ray from the eye meets the scene.
  Receiver seen(Vec3 eye, Vec3 direction) const {
    const Hit hit = tracer.closest(eye, direction, 100);
    const SurfacePoint p = tracer.surface(hit);
    Receiver r;
    r.position = r.origin = p.position;
    r.ng = glm::dot(p.geometricNormal, direction) < 0 ? p.geometricNormal : -p.geometricNormal;
    r.ns = r.ng;
    r.object = p.instance, r.triangle = p.triangle, r.u = p.u, r.v = p.v;
    return r;
  }
  std::vector<Vec3> atVertices(const PhotonPool& pool, const std::vector<Receiver>& points,
                               VertexLight& light) const {
    MapGatherScratch gather;
    VertexGatherScratch scratch;
    Receivers receivers;
    for (const Receiver& r : points) receivers.add(r);
    RayCounts rays;
    gatherAtVertices(*transport, pool, *vertices, light, 0, gather, scratch, receivers, rays);
    return valuesOf(receivers);
  }
  std::vector<Vec3> atPoints(const PhotonPool& pool, const std::vector<Receiver>& points) const {
    MapGatherScratch gather;
    Receivers receivers;
    for (const Receiver& r : points) receivers.add(r);
    RayCounts rays;
    gatherPoolAlone(*transport, pool, 1, 0, gather, receivers, rays);
    return valuesOf(receivers);
  }
  static std::vector<Vec3> valuesOf(const Receivers& receivers) {
    std::vector<Vec3> e;
    for (size_t i = 0; i < receivers.size(); ++i) e.push_back(receivers.irradiance(i));
    return e;
  }

  Scene scene;
  Tracer tracer;
  std::unique_ptr<Transport> transport;
  std::unique_ptr<MapVertices> vertices;
};

// Photons on a lattice over the floor, whose flux rises with x: E = 2 + x.
PhotonPool linearPhotons(int side) {
  std::vector<MapPhoton> photons;
  const float step = 4.0f / static_cast<float>(side);
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const Vec3 x(-2 + (static_cast<float>(i) + 0.5f) * step, 0,
                   -2 + (static_cast<float>(j) + 0.5f) * step);
      photons.push_back({x, Vec3(0, 1, 0), Flux((2 + x.x) * step * step), 0});
    }
  return {std::move(photons), MapIndex::grid};
}

std::vector<Receiver> downOn(const World& w, float half, int side) {
  std::vector<Receiver> points;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const auto at = [&](int k) {
        return half * (2 * (static_cast<float>(k) + 0.37f) / static_cast<float>(side) - 1);
      };
      points.push_back(w.seen(Vec3(at(i), 1, at(j)), Vec3(0, -1, 0)));
    }
  return points;
}

// A disk of r = 0.2 holds 1131 hits of a lattice, and loses or gains some 1 % at its rim. Between
// vertices E is what they tell: so it has their error, and no more.
TEST(VertexGather, LinearLightIsRightAtVerticesAndBetween) {
  Settings s;
  s.mapNearest = 1131, s.mapDistance = 0.4f;
  for (const int levels : {3, 5}) {
    const World w(floorOf().build(), s, levels);
    const PhotonPool pool = linearPhotons(380);
    VertexLight light(w.vertices->entries());
    const auto points = downOn(w, 1.2f, 12);
    const auto e = w.atVertices(pool, points, light);
    double worst = 0;
    for (size_t i = 0; i < points.size(); ++i) {
      const double expected = 2 + double(points[i].position.x);
      worst = std::max(worst, std::abs(double(e[i].x) / expected - 1));
    }
    EXPECT_LT(worst, 0.02) << levels;
  }
}

// At a vertex E is just what a point there finds.
TEST(VertexGather, IsTheEstimateOfAPointAtAVertex) {
  const World w(floorOf().build(), {}, 3);
  const PhotonPool pool = linearPhotons(60);
  VertexLight light(w.vertices->entries());
  std::vector<Receiver> points;
  for (uint32_t entry = 0; entry < w.vertices->count(); ++entry)
    points.push_back(w.vertices->receiver(entry));
  const auto expected = w.atPoints(pool, points);
  EXPECT_EQ(w.atVertices(pool, points, light), expected);
}

// Only vertices around what is seen, on the side from which it is seen.
TEST(VertexGather, AsksForWhatIsSeen) {
  const World w(floorOf().build(), {}, 4);
  const PhotonPool pool = linearPhotons(60);
  VertexLight light(w.vertices->entries());
  const auto points = downOn(w, 0.1f, 5);
  w.atVertices(pool, points, light);
  EXPECT_GT(light.count(), 3u);
  EXPECT_LE(light.count(), 16u);  // sides of 1/4, so that 0.2 x 0.2 m meets at most 3 x 3 cells
  for (uint32_t entry = w.vertices->count(); entry < w.vertices->entries(); ++entry)
    EXPECT_FALSE(light.find(entry));
  // From below there is no light, and it is asked for by itself.
  const auto below = w.atVertices(pool, {w.seen(Vec3(0.1f, -1, 0.1f), Vec3(0, 1, 0))}, light);
  EXPECT_EQ(below[0], Vec3(0));
}

// A room with things and a lamp, its photons, and what an eye sees of it.
struct Room {
  static Settings settings() {
    Settings s = testing::small(Method::photonMap, 8);
    s.mapPhotons = 4000, s.mapPerFrame = 1000, s.mapDirect = MapDirect::on;
    return s;
  }
  static Scene made() {
    SceneBuilder b;
    b.box(b.material(testing::matte(Vec3(0.5f))), Vec3(-1), Vec3(1), true);
    b.sphere(b.material(testing::matte(Vec3(0.7f))), Vec3(0.3f, -0.5f, -0.2f), 0.4f, 12);
    PunctualLight lamp;
    lamp.position = Vec3(-0.3f, 0.6f, 0.3f);
    return b.light(lamp).build();
  }
  explicit Room(int levels) : world(made(), settings(), levels) {
    const Renderer renderer(world.tracer, settings());
    pool = std::make_unique<PhotonPool>(readPhotons(stateAtRest(renderer, settings(), 0)),
                                        MapIndex::grid);
    for (int i = 0; i < 40; ++i)
      for (int j = 0; j < 40; ++j)
        points.push_back(
            world.seen(Vec3(0, 0, 0.9f), Vec3(0.05f * (static_cast<float>(i) - 19.7f),
                                              0.05f * (static_cast<float>(j) - 19.7f), -1)));
  }
  World world;
  std::unique_ptr<PhotonPool> pool;
  std::vector<Receiver> points;
};

TEST(VertexGather, IsTheSameWhoeverAsksFirst) {
  const Room room(4);
  VertexLight light(room.world.vertices->entries());
  const auto expected = room.world.atVertices(*room.pool, room.points, light);
  auto turned = room.points;
  std::reverse(turned.begin(), turned.end());
  VertexLight other(room.world.vertices->entries());
  auto e = room.world.atVertices(*room.pool, turned, other);
  std::reverse(e.begin(), e.end());
  EXPECT_EQ(e, expected);
  EXPECT_EQ(light.count(), other.count());
  VertexLight shared(room.world.vertices->entries());
  std::vector<std::vector<Vec3>> found(4);
  std::vector<std::thread> threads;
  for (auto& mine : found)
    threads.emplace_back([&] { mine = room.world.atVertices(*room.pool, room.points, shared); });
  for (auto& thread : threads) thread.join();
  for (const auto& mine : found) EXPECT_EQ(mine, expected);
}

// Squared difference from the estimate at the points themselves. Estimates of two points less than
// r apart share most of their photons, so that it falls with each level: by about four, as long as
// what lies between vertices is smooth.
TEST(VertexGather, TendsToTheEstimateAtPixels) {
  double before = 0;
  for (const int levels : {1, 3, 5}) {
    const Room room(levels);
    VertexLight light(room.world.vertices->entries());
    const auto e = room.world.atVertices(*room.pool, room.points, light);
    const auto at = room.world.atPoints(*room.pool, room.points);
    double error = 0, sum = 0;
    for (size_t i = 0; i < e.size(); ++i) {
      error += double(e[i].x - at[i].x) * double(e[i].x - at[i].x);
      sum += double(at[i].x) * double(at[i].x);
    }
    EXPECT_TRUE(levels == 1 || error / sum < 0.5 * before) << levels;
    before = error / sum;
  }
  EXPECT_LT(before, 0.01);
}

}  // namespace
}  // namespace ninefold
