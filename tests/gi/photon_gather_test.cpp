// What receivers find in the pool: groups find what single searches find; a disk counts as far as
// there is surface; what lies behind or beyond walls.
#include <gtest/gtest.h>

#include "common/gi/photon_map/map_gather.h"
#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

// A floor from -2 to 2 in x and z, the front upwards.
SceneBuilder floorOf(float side = 4) {
  SceneBuilder b;
  b.quad(b.material(testing::matte(Vec3(0.5f))), Vec3(-side / 2, 0, side / 2), Vec3(side, 0, 0),
         Vec3(0, 0, -side));
  return b;
}

Receiver receiverAt(Vec3 x, Vec3 n, uint32_t pixel) {
  Receiver r;
  r.position = r.origin = x, r.ng = r.ns = n, r.pixel = pixel;
  return r;
}

struct World {
  explicit World(SceneBuilder& b, Settings s = {})
      : scene(b.build()), tracer(scene, Isa::automatic), transport(tracer, s) {}
  Scene scene;
  Tracer tracer;
  Transport transport;
};

std::vector<Vec3> irradiance(const World& world, const PhotonPool& pool,
                             const std::vector<Receiver>& points, bool alone) {
  MapGatherScratch scratch;
  RayCounts rays;
  std::vector<Vec3> all;
  Receivers receivers;
  const auto gather = [&] {
    receivers.pad();
    gatherPool(world.transport, pool, 1, 0, scratch, receivers, rays);
    for (size_t i = 0; i < receivers.size(); ++i) all.push_back(receivers.irradiance(i));
    receivers.clear();
  };
  for (Receiver r : points) {
    const Hit hit = world.tracer.closest(r.position + 1e-3f * r.ng, -r.ng, 2e-3f);
    r.object = hit.instance, r.triangle = hit.triangle;
    receivers.add(r);
    if (alone) gather();
  }
  if (!alone) gather();
  return all;
}

// In the middle of a floor all disks are whole, to the last bit, so that E tells what was found.
// Receivers are dense and sparse, photons everywhere or in a corner of them.
TEST(PhotonGather, GroupsFindWhatSingleSearchesFind) {
  SceneBuilder b = floorOf(40);
  for (const float spacing : {0.001f, 0.02f, 0.3f})
    for (const int photonCount : {1, 60, 3000})
      for (const bool even : {true, false}) {
        Settings s;
        s.mapNearest = 50, s.mapDistance = 0.05f;
        const World world(b, s);
        std::vector<MapPhoton> photons;
        for (int i = 0; i < photonCount; ++i) {
          const float u = std::fmod(0.754877666f * static_cast<float>(i), 1.0f);
          const float v = std::fmod(0.569840296f * static_cast<float>(i), 1.0f);
          const Vec3 at = even ? Vec3(4 * u - 2, 0, 4 * v - 2) : Vec3(u * u * u, 0, v * v * v);
          photons.push_back({at, Vec3(0, 1, 0), Flux(1, 0.5f * u, v), 0});
        }
        std::vector<Receiver> points;
        for (int i = 0; i < 200; ++i)
          points.push_back(
              receiverAt(spacing * Vec3(static_cast<float>(i % 14), 0, static_cast<float>(i / 14)),
                         Vec3(0, 1, 0), static_cast<uint32_t>(i)));
        const PhotonPool pool(photons, MapIndex::grid);
        EXPECT_EQ(irradiance(world, pool, points, false), irradiance(world, pool, points, true))
            << spacing << ", " << photonCount;
      }
}

// E = (m - 1)/(pi r^2) Phi on a lattice of photons, and N/(pi D^2) Phi of few within D.
TEST(PhotonGather, CountsTheNearestOverTheirDisk) {
  SceneBuilder b = floorOf(40);
  Settings s;
  s.mapNearest = 5, s.mapDistance = 0.1f;
  const World world(b, s);
  std::vector<MapPhoton> photons;
  for (int i = 1; i <= 9; ++i)
    photons.push_back({Vec3(0.1f * static_cast<float>(i), 0, 0), Vec3(0, 1, 0), Flux(2), 0});
  photons.push_back({Vec3(0, 0, 0.05f), Vec3(0, -1, 0), Flux(100), 0});  // from below
  photons.push_back({Vec3(0, 1, 0), Vec3(0, 1, 0), Flux(100), 0});       // too high
  photons.push_back({Vec3(0.1f, 0, 0), Vec3(1, 0, 0), Flux(100), 0});    // on a wall
  const PhotonPool pool(photons, MapIndex::tree);
  const auto e = irradiance(world, pool, {receiverAt(Vec3(0), Vec3(0, 1, 0), 0)}, true);
  EXPECT_NEAR(e[0].x, 4 * 2 / (kPi * 0.25f), 1e-4f);
  s.mapNearest = 50;
  const World sparse(b, s);
  const float d = 0.1f * sparse.transport.radius;
  const auto all = irradiance(sparse, pool, {receiverAt(Vec3(0), Vec3(0, 1, 0), 0)}, true);
  EXPECT_NEAR(all[0].x, 9 * 2 / (kPi * d * d), 1e-4f);
}

// D vertices of photon and eye path together.
TEST(PhotonGather, LeavesOutLongerPaths) {
  SceneBuilder b = floorOf(40);
  for (const int length : {0, 1, 2, 3}) {
    Settings s;
    s.pathLength = length, s.mapNearest = 50;
    const World world(b, s);
    std::vector<MapPhoton> photons;
    for (const uint32_t before : {0u, 1u, 2u}) {
      Flux flux(0);
      flux[static_cast<int>(before)] = 1;
      photons.push_back({Vec3(0.1f, 0, 0), Vec3(0, 1, 0), flux, before});
    }
    const PhotonPool pool(photons, MapIndex::grid);
    const Vec3 e = irradiance(world, pool, {receiverAt(Vec3(0), Vec3(0, 1, 0), 0)}, true)[0];
    for (int before = 0; before < 3; ++before)
      EXPECT_EQ(e[before] > 0, length == 0 || before < length) << length;
  }
}

// f of one point on the first instance, which is seen from its back if `turned`.
float cover(const World& world, Vec3 x, float r, float height = 0.05f, float turn = 0.3f,
            bool turned = false) {
  SurfaceCover surface;
  RayCounts rays;
  SurfaceCover::Disks disks;
  disks.centre = x, disks.normal = Vec3(0, 1, 0);
  disks.least = disks.most = r, disks.height = height, disks.turn = turn;
  disks.own = 0, disks.turned = turned;
  surface.shoot(world.transport, disks, rays);
  return surface.share(x, Vec3(0, 1, 0), r);
}

// The mean over turns of the pattern.
float meanCover(const World& world, Vec3 x, float r) {
  float sum = 0;
  for (int i = 0; i < 32; ++i) sum += cover(world, x, r, 0.05f, static_cast<float>(i) / 32) / 32;
  return sum;
}

// A half at a straight edge, a quarter in a corner; nearer than r to an edge, the disk without its
// segment: 1 - (acos t - t sqrt(1 - t^2))/pi at t r from the edge. Bias: the ray in the middle
// counts for the edge itself.
TEST(SurfaceCover, IsThePartOfADiskThatThereIs) {
  SceneBuilder b = floorOf();
  const World world(b);
  EXPECT_EQ(cover(world, Vec3(0), 0.5f), 1);
  EXPECT_NEAR(meanCover(world, Vec3(1.999f, 0, 0), 0.5f), 0.5f, 0.03f);
  EXPECT_NEAR(meanCover(world, Vec3(1.999f, 0, 1.999f), 0.5f), 0.25f, 0.03f);
  for (const float t : {0.2f, 0.5f, 0.8f}) {
    const float expected = 1 - (std::acos(t) - t * std::sqrt(1 - t * t)) / kPi;
    EXPECT_NEAR(meanCover(world, Vec3(2 - 0.5f * t, 0, 0), 0.5f), expected, 0.02f) << t;
    EXPECT_NEAR(cover(world, Vec3(2 - 0.5f * t, 0, 0), 0.5f), expected, 0.06f) << t;
  }
}

// Walls that stand on the floor, a table far above it, a cellar far below and glass on it do not
// count. Paper on half of it takes the place of the floor below.
TEST(SurfaceCover, CountsWhatAcceptsPhotons) {
  SceneBuilder b = floorOf();
  const int grey = b.material(testing::matte(Vec3(0.5f)));
  b.quad(grey, Vec3(0.1f, 0, -1), Vec3(0, 0, 2), Vec3(0, 1, 0));
  b.quad(grey, Vec3(-1, 0.5f, 1), Vec3(2, 0, 0), Vec3(0, 0, -2));
  b.quad(grey, Vec3(-1, -0.5f, 1), Vec3(2, 0, 0), Vec3(0, 0, -2));
  b.box(b.material(testing::glass(1.5f)), Vec3(-0.5f, 0.001f, -0.5f), Vec3(-0.1f, 0.02f, 0.5f),
        false);
  EXPECT_EQ(cover(World(b), Vec3(0), 0.4f), 1);
  b.quad(grey, Vec3(0, 0.01f, 1), Vec3(1, 0, 0), Vec3(0, 0, -2));
  EXPECT_EQ(cover(World(b), Vec3(-0.1f, 0, 0), 0.3f), 1);
}

// A ceiling that hangs within D/8 over the floor looks down.
TEST(SurfaceCover, ALowCeilingDoesNotCount) {
  SceneBuilder b = floorOf();
  b.quad(b.material(testing::matte(Vec3(0.5f))), Vec3(-1, 0.02f, -1), Vec3(2, 0, 0), Vec3(0, 0, 2));
  EXPECT_EQ(cover(World(b), Vec3(0), 0.4f), 1);
}

// A sheet that is wound the wrong way is surface to those who see it.
TEST(SurfaceCover, ASheetSeenFromItsBackCounts) {
  SceneBuilder b;
  b.quad(b.material(testing::matte(Vec3(0.5f))), Vec3(-2, 0, -2), Vec3(4, 0, 0), Vec3(0, 0, 4));
  EXPECT_EQ(cover(World(b), Vec3(0), 0.4f, 0.05f, 0.3f, true), 1);
}

// Two rooms with a wall between them, a lamp in one. On the other side of the wall it is dark: hits
// there landed on the other side. On the floor of the dark room light leaks in, as far as r:
// photons of the lit floor are near, and of its side. More than r away it is black.
TEST(PhotonGather, LeaksUnderAPartitionNoFurtherThanItsDisks) {
  const auto picture = [](Vec3 eye, Vec3 target) {
    SceneBuilder b;
    const int grey = b.material(testing::matte(Vec3(0.5f)));
    b.box(grey, Vec3(-2, -1, -1), Vec3(2, 1, 1), true);
    b.quad(grey, Vec3(0, -1, -1), Vec3(0, 0, 2), Vec3(0, 2, 0));
    PunctualLight light;
    light.position = Vec3(-1, 0, 0), light.intensity = Vec3(1);
    b.light(light).camera(eye, target, 0.02f, Vec3(0, 0, 1));
    const Scene scene = b.build();
    const Tracer tracer(scene, Isa::automatic);
    auto s = testing::small(Method::photonMap, 4);
    s.mapPhotons = 4000, s.mapPerFrame = 1000, s.mapNearest = 50, s.mapDistance = 0.1f;
    return testing::render(tracer, s, 16).grey();
  };
  const float d = 0.1f * std::sqrt(6.0f);  // D; R = sqrt(4 + 1 + 1)
  const double lit = picture(Vec3(-0.5f, 0, 0), Vec3(-0.5f, -1, 0));
  EXPECT_GT(lit, 0.01);
  EXPECT_EQ(picture(Vec3(0.5f, 0, 0), Vec3(0, 0, 0.1f)), 0);
  EXPECT_EQ(picture(Vec3(1.1f * d, 0, 0), Vec3(1.1f * d, -1, 0)), 0);
  const double leak = picture(Vec3(0.1f * d, 0, 0), Vec3(0.1f * d, -1, 0));
  EXPECT_LT(leak, 0.7 * lit);
  EXPECT_GT(leak, 0) << "say so at the head of map_gather.h if it leaks no more";
}

}  // namespace
}  // namespace ninefold
