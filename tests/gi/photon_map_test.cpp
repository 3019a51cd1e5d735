// The photon map's own promises: the pool holds the lamps' flux at each moment, units can be made
// in any order and again, and each path is found once.
//
// Its bias is stated by each test: light from the pool is blurred over r, the distance of the m-th
// hit. Where E is smooth that is E'' r^2/8 for each of two directions; at shadows' edges it is as
// large as the step, over r.
#include <gtest/gtest.h>

#include <numeric>

#include "common/gi/photon_map/shooting.h"
#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

constexpr float kAlbedo = 0.5f;

PunctualLight pointAt(Vec3 position, float intensity) {
  PunctualLight light;
  light.position = position, light.intensity = Vec3(intensity);
  return light;
}

// A closed room with a point light of 1 W/sr and a lamp of 0.2 m^2 and 3 W/(m^2 sr).
constexpr float kPoint = 1, kLampArea = 0.2f, kLampRadiance = 3;
const double kAllFlux =
    double(kPi) * (4 * double(kPoint) + double(kLampArea) * double(kLampRadiance));
Scene litRoom(float albedo = kAlbedo) {
  SceneBuilder b;
  b.box(b.material(testing::matte(Vec3(albedo))), Vec3(-1), Vec3(1), true);
  b.quad(b.material(testing::matte(Vec3(albedo), Vec3(kLampRadiance))), Vec3(-0.25f, 0.9f, -0.2f),
         Vec3(0.5f, 0, 0), Vec3(0, 0, 0.4f));
  b.light(pointAt(Vec3(0.3f, -0.2f, 0.4f), kPoint));
  b.camera(Vec3(0, 0, 0.9f), Vec3(0.1f, -0.3f, -1), 1.0f);
  return b.build();
}

// The same with the point light alone.
Scene litByPoint() {
  SceneBuilder b;
  b.box(b.material(testing::matte(Vec3(kAlbedo))), Vec3(-1), Vec3(1), true);
  return b.light(pointAt(Vec3(0.3f, -0.2f, 0.4f), kPoint)).build();
}

Settings poolOf(int photons, int perFrame) {
  Settings s = testing::small(Method::photonMap, 8);
  s.mapPhotons = photons, s.mapPerFrame = perFrame;
  return s;
}

// A pool that is made unit by unit.
class Ring {
 public:
  Ring(const Tracer& tracer, const Settings& settings) : renderer_(tracer, settings) {}
  Ring& make(uint32_t unit, uint32_t randomization = 0) {
    StepKey key;
    key.randomization = randomization;
    pages_.apply(renderer_.step(pages_, key, unit).deltas);
    return *this;
  }
  Ring& make(const std::vector<uint32_t>& units) {
    for (const uint32_t unit : units) make(unit);
    return *this;
  }
  const StatePages& pages() const { return pages_; }
  std::vector<MapPhoton> photons() const { return readPhotons(pages_); }
  // Of those that came straight from a lamp, or of all.
  double flux(bool onlyStraight) const {
    double sum = 0;
    for (const MapPhoton& p : photons())
      if (!onlyStraight || p.diffuseBefore == 0) sum += static_cast<double>(p.flux.x);
    return sum;
  }

 private:
  Renderer renderer_;
  StatePages pages_;
};

std::vector<uint32_t> unitsFrom(uint32_t first, uint32_t count) {
  std::vector<uint32_t> units(count);
  std::iota(units.begin(), units.end(), first);
  return units;
}

// In a closed room all flux arrives: Phi in straight hits, whatever the ring has gone through. With
// one lamp each path carries Phi/total exactly. Of several, lamps are chosen nearly in proportion
// to power, and 400 paths tell their shares to a few percent.
TEST(PhotonMap, ThePoolHoldsTheLampsFluxAtEachMoment) {
  const Scene scene = litRoom();
  const Tracer tracer(scene, Isa::automatic);
  for (const auto distribution : {MapDistribution::random, MapDistribution::frame,
                                  MapDistribution::turn, MapDistribution::nets}) {
    Settings s = poolOf(400, 50);
    s.mapDirect = MapDirect::on, s.mapDistribution = distribution;
    Ring ring(tracer, s);
    ring.make(unitsFrom(0, 8));
    for (uint32_t unit = 8; unit < 30; ++unit)
      EXPECT_NEAR(ring.make(unit).flux(true), kAllFlux, 0.05 * kAllFlux);
    const Scene one = litByPoint();
    const Tracer alone(one, Isa::automatic);
    EXPECT_NEAR(Ring(alone, s).make(unitsFrom(3, 8)).flux(true), 4 * double(kPi) * double(kPoint),
                1e-4);
    EXPECT_NEAR(ring.flux(false), kAllFlux / (1 - double(kAlbedo)), 0.2 * kAllFlux);
  }
}

// Half of the turn after a lamp was dimmed to a half, half of the pool has its old power.
TEST(PhotonMap, ADimmedLampGoesWithThePhotonsThatAreReplaced) {
  const Scene bright = litByPoint();
  Scene dim = bright;
  dim.lights[0].intensity *= 0.5f;
  const Tracer before(bright, Isa::automatic), after(dim, Isa::automatic);
  Settings s = poolOf(400, 50);
  s.mapDirect = MapDirect::on;
  const Renderer bothHalves[] = {Renderer(before, s), Renderer(after, s)};
  StatePages pages;
  const auto flux = [&] {
    double sum = 0;
    for (const MapPhoton& p : readPhotons(pages))
      if (p.diffuseBefore == 0) sum += static_cast<double>(p.flux.x);
    return sum / (4 * double(kPi) * double(kPoint));
  };
  for (uint32_t unit = 0; unit < 8; ++unit)
    pages.apply(bothHalves[0].step(pages, StepKey{}, unit).deltas);
  for (uint32_t unit = 8; unit < 16; ++unit) {
    pages.apply(bothHalves[1].step(pages, StepKey{}, unit).deltas);
    EXPECT_NEAR(flux(), 1 - 0.5 * (unit - 7) / 8, 1e-4);
  }
}

// Walls of 0.985: 67 hits a path, and room for 64. Phi / (1 - a) arrives all the same.
TEST(PhotonMap, WhatHasNoRoomIsThinnedAndLosesNothing) {
  const Scene scene = litRoom(0.985f);
  const Tracer tracer(scene, Isa::automatic);
  Settings s = poolOf(4000, 1000);
  s.mapDirect = MapDirect::on;
  double sum = 0;
  constexpr uint32_t kSets = 10;
  for (uint32_t i = 0; i < kSets; ++i) {
    Ring ring(tracer, s);
    for (uint32_t unit = 0; unit < 4; ++unit) ring.make(unit, i);
    EXPECT_LE(ring.photons().size(), 4 * MapLayout(s).room());
    sum += ring.flux(false) / kSets;
  }
  EXPECT_NEAR(sum * (1 - 0.985) / kAllFlux, 1, 0.02);
}

TEST(PhotonMap, UnitsAreTheSameBitsInAnyOrder) {
  const Scene scene = litRoom();
  const Tracer tracer(scene, Isa::automatic);
  for (const auto distribution : {MapDistribution::random, MapDistribution::nets}) {
    Settings s = poolOf(400, 50);
    s.mapDistribution = distribution;
    const auto hash = [&](const std::vector<uint32_t>& units) {
      return Ring(tracer, s).make(units).pages().hash();
    };
    const uint64_t expected = hash(unitsFrom(0, 8));
    EXPECT_EQ(hash({7, 3, 0, 1, 6, 2, 5, 4}), expected);
    EXPECT_EQ(hash({0, 1, 2, 3, 3, 3, 4, 5, 6, 7, 0}), expected);
    // The next turn: the same once more, or, by chance, other ones in the same places.
    auto turned = unitsFrom(0, 8);
    turned.push_back(8);
    EXPECT_EQ(hash(turned) == expected, distribution == MapDistribution::nets);
    EXPECT_EQ(hash({8, 1, 2, 3, 4, 5, 6, 7}), hash(turned));
    Ring other(tracer, s);
    for (uint32_t unit = 0; unit < 8; ++unit) other.make(unit, 1);
    EXPECT_NE(other.pages().hash(), expected);
  }
}

TEST(PhotonMap, PartsOfFrameAndTurnAreAlikeAsTheySay) {
  const Scene scene = litRoom();
  const Tracer tracer(scene, Isa::automatic);
  const auto first = [&](MapDistribution distribution, uint32_t unit) {
    Settings s = poolOf(400, 50);
    s.mapDirect = MapDirect::on, s.mapDistribution = distribution;
    return Ring(tracer, s).make(unit).photons().front();
  };
  EXPECT_EQ(first(MapDistribution::frame, 0), first(MapDistribution::frame, 3));
  EXPECT_FALSE(first(MapDistribution::turn, 0) == first(MapDistribution::turn, 3));
  EXPECT_EQ(first(MapDistribution::turn, 3), first(MapDistribution::turn, 11));
  EXPECT_FALSE(first(MapDistribution::nets, 0) == first(MapDistribution::nets, 3));
  EXPECT_EQ(first(MapDistribution::nets, 3), first(MapDistribution::nets, 11));
  EXPECT_FALSE(first(MapDistribution::random, 3) == first(MapDistribution::random, 11));
}

TEST(PhotonMap, SavesWhatThePathLengthAllows) {
  const Scene scene = litRoom();
  const Tracer tracer(scene, Isa::automatic);
  for (const int length : {1, 2, 3})
    for (const MapDirect direct : {MapDirect::off, MapDirect::on}) {
      Settings s = poolOf(400, 50);
      s.pathLength = length, s.mapDirect = direct;
      uint32_t most = 0;
      const auto photons = Ring(tracer, s).make(unitsFrom(0, 8)).photons();
      for (const MapPhoton& p : photons) most = std::max(most, p.diffuseBefore + 1);
      const bool none = length == 1 && direct == MapDirect::off;
      EXPECT_EQ(most, none ? 0 : static_cast<uint32_t>(length));
      EXPECT_EQ(photons.empty(), none);
    }
}

// Under a point light at height 1: E = I cos/d^2 = 1/(1 + s^2)^(3/2), s from the point below it.
// Bias: at s = 0 E falls by 3/2 s^2 of itself, so a disk of radius r has 3/4 r^2 less; 20,000 paths
// over all directions give r^2 = m / (20000/(4 pi)) = 0.03 for m = 50, hence 2.3 %.
TEST(PhotonMap, DirectLightUnderALampMeetsItsFormula) {
  SceneBuilder b;
  b.quad(b.material(testing::matte(Vec3(kAlbedo))), Vec3(-4, 0, 4), Vec3(8, 0, 0), Vec3(0, 0, -8));
  b.light(pointAt(Vec3(0, 1, 0), 1));
  for (const float s : {0.0f, 0.5f, 1.0f}) {
    b.camera(Vec3(s, 0.8f, 0), Vec3(s, 0, 0), 0.02f, Vec3(0, 0, 1));
    auto e = testing::estimator(factsOf(Method::photonMap), 4, 1);
    e.settings.mapDirect = MapDirect::on;
    e.settings.mapPhotons = 20000, e.settings.mapPerFrame = 5000, e.settings.mapNearest = 50;
    const double expected =
        double(kAlbedo) / double(kPi) / std::pow(1 + double(s) * double(s), 1.5);
    testing::expectRadiance(b.build(), {e}, expected, {.frames = 64, .bias = 0.03, .error = 0.02},
                            "s = " + testing::number(double(s)));
  }
}

// Whichever index finds them: the same bits.
TEST(PhotonMap, IndexesGiveTheSamePicture) {
  const Scene scene = litRoom();
  const Tracer tracer(scene, Isa::automatic);
  Settings s = poolOf(2000, 100);
  s.width = s.height = 48;
  const auto byGrid = testing::render(tracer, s, 2);
  s.mapIndex = MapIndex::tree;
  EXPECT_EQ(testing::render(tracer, s, 2).pixels, byGrid.pixels);
}

TEST(PhotonMap, WithoutLampsThereIsNothing) {
  SceneBuilder b;
  b.box(b.material(testing::matte(Vec3(kAlbedo))), Vec3(-1), Vec3(1), true);
  const Scene scene = b.build();
  const Tracer tracer(scene, Isa::automatic);
  const Settings s = poolOf(400, 50);
  Ring ring(tracer, s);
  EXPECT_TRUE(ring.make(unitsFrom(0, 8)).photons().empty());
  EXPECT_EQ(testing::render(tracer, s, 2).grey(), 0);
}

// A room with all kinds of S lobes: a glass ball, a smooth mirror, a glossy wall.
Scene mixedRoom() {
  SceneBuilder b;
  const int wall = b.material(testing::matte(Vec3(0.6f)));
  Material glossy = testing::mirror(Vec3(0.8f));
  glossy.roughness = 0.5f;
  b.box(wall, Vec3(-1), Vec3(1), true);
  b.quad(b.material(testing::matte(Vec3(0), Vec3(6))), Vec3(-0.3f, 0.95f, -0.3f), Vec3(0.6f, 0, 0),
         Vec3(0, 0, 0.6f));
  b.sphere(b.material(testing::glass(1.5f)), Vec3(0.4f, -0.6f, -0.1f), 0.3f, 24);
  b.quad(b.material(testing::mirror(Vec3(0.9f))), Vec3(-0.9f, -0.8f, -0.5f), Vec3(0.5f, 0, -0.4f),
         Vec3(0, 1, 0));
  b.quad(b.material(glossy), Vec3(0.95f, -0.9f, -0.9f), Vec3(0, 0, 1.2f), Vec3(0, 1.4f, 0));
  b.camera(Vec3(0, 0.1f, 0.95f), Vec3(0, -0.2f, -1), 1.3f);
  return b.build();
}

testing::Estimator large(MapDirect direct, int pathLength) {
  auto e = testing::estimator(factsOf(Method::photonMap), 12, pathLength);
  e.settings.mapDirect = direct;
  e.settings.mapPhotons = 20000, e.settings.mapPerFrame = 5000, e.settings.mapNearest = 50;
  return e;
}

// Bias: 2 % of the mean, blur over edges of walls and things; and 3 % with direct light in the
// pool, whose shadows' edges and the lamp's surroundings blur.
void expectEachPathOnce(int length, int frames) {
  const Scene scene = mixedRoom();
  const Tracer tracer(scene, Isa::automatic);
  const auto expected = testing::render(tracer, testing::reference(12, length).settings, 300);
  for (const MapDirect direct : {MapDirect::off, MapDirect::on}) {
    const auto image = testing::render(tracer, large(direct, length).settings, frames);
    const double bias = direct == MapDirect::on ? 0.03 : 0.02;
    const double error = std::hypot(image.error(), expected.error());
    EXPECT_NEAR(image.grey(), expected.grey(), 4 * error + bias * expected.grey())
        << "path length " << length << (direct == MapDirect::on ? ", direct " : ", ") << "ratio "
        << image.grey() / expected.grey() << " +- " << error / expected.grey();
    EXPECT_LT(error, 0.025 * expected.grey());
  }
}

TEST(PhotonMap, FindsEachPathOfOneVertexOnce) { expectEachPathOnce(1, 64); }
TEST(PhotonMap, FindsEachPathOfTwoVerticesOnce) { expectEachPathOnce(2, 32); }
TEST(PhotonMap, FindsEachPathOfFourVerticesOnce) { expectEachPathOnce(4, 24); }
TEST(PhotonMap, FindsEachPathOnce) { expectEachPathOnce(0, 24); }

testing::Estimator atVertices(int side, int pathLength) {
  auto e = testing::mapAtVertices(side, pathLength);
  e.settings.mapPhotons = 20000, e.settings.mapPerFrame = 5000, e.settings.mapNearest = 50;
  e.settings.mapSubdivision = 5;
  return e;
}

// L = 1/(1 - a) in every pixel. Bias: where a vertex lies in an edge half of its disk is empty, and
// the mean of 1/f is above 1/(mean of f): by 1/4 (1/16)^2 there, if of 16 rays one more or less may
// miss, and by some percent in corners.
TEST(PhotonMap, AtVerticesAFurnaceIsWhite) {
  SceneBuilder b;
  b.box(b.material(testing::matte(Vec3(kAlbedo), Vec3(1))), Vec3(-1), Vec3(1), true);
  b.camera(Vec3(0.1f, 0.2f, 0.3f), Vec3(-1, -0.4f, -0.2f), 1.2f);
  for (const int length : {0, 2})
    testing::expectRadiance(
        b.build(), {atVertices(12, length)}, testing::furnaceRadiance(double(kAlbedo), length),
        {.frames = 24, .bias = 0.01, .error = 0.02}, "length " + testing::number(length));
}

// As FindsEachPathOnce.
TEST(PhotonMap, AtVerticesItFindsEachPathOnce) {
  const Scene scene = mixedRoom();
  const Tracer tracer(scene, Isa::automatic);
  for (const int length : {2, 0}) {
    const auto expected = testing::render(tracer, testing::reference(12, length).settings, 300);
    const auto image = testing::render(tracer, atVertices(12, length).settings, 24);
    const double error = std::hypot(image.error(), expected.error());
    EXPECT_NEAR(image.grey(), expected.grey(), 4 * error + 0.03 * expected.grey())
        << "path length " << length << ", ratio " << image.grey() / expected.grey();
    EXPECT_LT(error, 0.025 * expected.grey());
  }
}

// Without caustics what is left is what instant radiosity's VPLs bring: the same split.
TEST(PhotonMap, WithoutCausticsItLacksWhatInstantRadiosityLacks) {
  const Scene scene = mixedRoom();
  const Tracer tracer(scene, Isa::automatic);
  for (const int length : {1, 2, 0}) {
    auto radiosity = testing::radiosity(12, length);
    radiosity.settings.caustics = Caustics::off;
    auto map = large(MapDirect::off, length);
    map.settings.caustics = Caustics::off;
    const auto expected = testing::render(tracer, radiosity.settings, 200);
    const auto image = testing::render(tracer, map.settings, 48);
    const double error = std::hypot(image.error(), expected.error());
    EXPECT_NEAR(image.grey(), expected.grey(), 4 * error + 0.02 * expected.grey())
        << "path length " << length << " ratio " << image.grey() / expected.grey();
    EXPECT_LT(error, 0.03 * expected.grey());
  }
}

}  // namespace
}  // namespace ninefold
