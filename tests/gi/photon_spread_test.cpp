// Whether photons lie evenly, against patterns whose measure is known in closed form, and what that
// does for a caustic with a straight rim.
#include "common/gi/photons/photon_spread.h"

#include <gtest/gtest.h>

#include "common/gi/radiosity/radiosity.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

constexpr Vec3 kUp(0, 1, 0);

// n photons of flux 1 and lamp 0 on the disc of radius 1 in y = 0, evenly; where(x) says which
// stay.
template <typename Where>
PhotonSpread disc(int n, Where&& where) {
  PhotonSpread spread;
  for (int i = 0; i < n; ++i) {
    const float r = std::sqrt((static_cast<float>(i) + 0.5f) / static_cast<float>(n));
    const float angle = 2.39996323f * static_cast<float>(i);  // the golden angle
    const Vec3 x(r * std::cos(angle), 0, r * std::sin(angle));
    if (where(x)) spread.add({x, kUp, 1, 0});
  }
  return spread;
}

PhotonSpread::Landing at(Vec3 x) { return {x, kUp, 1, 0}; }

TEST(PhotonSpread, IsEvenOnAWholeDiscAndUnevenAtItsRim) {
  const PhotonSpread spread = disc(3000, [](Vec3) { return true; });
  for (const float r : {0.1f, 0.3f, 1.0f}) EXPECT_FALSE(spread.isUneven(at(Vec3(0)), r)) << r;
  EXPECT_TRUE(spread.isUneven(at(Vec3(0.99f, 0, 0)), 0.2f));
  EXPECT_TRUE(spread.isUneven(at(Vec3(0)), 2));  // a spot half as wide: s^2 = 1/4
}

// x at a distance h from the rim of what is lit, in a disc of radius 1:
//
//   s^2(h) = 2 (Q/F - (M/F)^2),   Y = sqrt(1 - X^2)
//   F, M, Q = integral over X < h of 2Y, 2XY, 2X^2 Y + 2/3 Y^3
//
// which is 0.64, 0.69, 0.78, 0.86 for h = 0, 0.1, 0.3, 0.5.
TEST(PhotonSpread, IsUnevenAtARimAndNotFarFromIt) {
  const auto lit = [](float h) { return disc(3000, [&](Vec3 x) { return x.x < h; }); };
  for (const float h : {0.0f, 0.1f}) EXPECT_TRUE(lit(h).isUneven(at(Vec3(0)), 1)) << h;
  for (const float h : {0.3f, 0.5f}) EXPECT_FALSE(lit(h).isUneven(at(Vec3(0)), 1)) << h;
}

TEST(PhotonSpread, IsUnevenOnALine) {
  PhotonSpread line;
  for (int i = 0; i < 99; ++i) line.add({Vec3(static_cast<float>(i - 49) / 49, 0, 0), kUp, 1, 0});
  EXPECT_TRUE(line.isUneven(at(Vec3(0)), 1));
}

// What does not count: fewer than five, other lamps, what landed on another side.
TEST(PhotonSpread, NeedsFivePhotonsOfTheLampOnThisSide) {
  for (int n = 1; n < 8; ++n) {
    PhotonSpread point;
    for (int i = 0; i < n; ++i) point.add(at(Vec3(0)));
    EXPECT_EQ(point.isUneven(at(Vec3(0)), 1), n >= 5) << n;
    EXPECT_FALSE(point.isUneven({Vec3(0), kUp, 1, 7}, 1)) << n;
    EXPECT_FALSE(point.isUneven({Vec3(0), -kUp, 1, 0}, 1)) << n;
    EXPECT_FALSE(point.isUneven({Vec3(0), kUp, 2, 0}, 1)) << n;  // as bright as two of them
    EXPECT_EQ(point.isUneven({Vec3(0), kUp, 0.5f, 0}, 1), 2 * n >= 5) << n;
  }
  EXPECT_FALSE(PhotonSpread().isUneven(at(Vec3(0)), 1));
}

// The sun shines askew on a square mirror, past a ceiling on which its light lies as a square of
// half side a.
Scene sunOnAMirror(float a) {
  SceneBuilder b;
  b.quad(b.material(testing::mirror()), Vec3(-a, 0, -a), Vec3(0, 0, 2 * a), Vec3(2 * a, 0, 0));
  b.quad(b.material(testing::matte(Vec3(0.5f))), Vec3(-0.2f, 1, -1.5f), Vec3(2.6f, 0, 0),
         Vec3(0, 0, 3));
  PunctualLight sun;
  sun.kind = LightKind::directional, sun.intensity = Vec3(1);
  sun.direction = glm::normalize(Vec3(1, -1, 0));
  b.light(sun);
  b.camera(Vec3(0, 0.5f, 3), Vec3(0, 1, 0), 1);
  return b.build();
}

// Part of a disc of radius 1 that is beyond a line at a distance h from its middle.
double beyond(double h) {
  return h >= 1 ? 0 : (std::acos(h) - h * std::sqrt(1 - h * h)) / double(kPi);
}

// Discs of radius r carry E r 2/(3 pi) over each metre of a straight rim: the integral of
// beyond(h/r) over h is 2r/(3 pi). Photons at the rim are narrower, those in the middle are not.
TEST(PhotonSpread, LessLightLeaksOverAStraightRim) {
  constexpr float a = 0.6f;
  const Scene scene = sunOnAMirror(a);
  const Tracer tracer(scene, Isa::automatic);
  Settings settings;
  settings.photons = 4000, settings.caustics = Caustics::direct;
  settings.photonRadius = 0.2f / scene.bounds.radius();
  const Transport t(tracer, settings);
  const float r = 0.2f;
  const PhotonRadii radii(t, r);
  double leak = 0, wide = 0, middle = 0, narrowInTheMiddle = 0;
  for (int k = 0; k < 9; ++k) {
    const LightSet set = makeLightSet(t, FrameKey{0, 0, 0, r}, k, 0);
    for (size_t kind = 0; kind < kPhotonKinds; ++kind)
      for (const Photon& p : set.photons[kind].photons()) {
        ASSERT_EQ(radii.choose(p.flux), kPhotonHalvings);  // by its flux alone it has r
        const double flux = double(p.flux.x) / 9, h = double(a - std::abs(p.position.z));
        leak += flux * beyond(h / double(radii.radius(kind))), wide += flux * beyond(h / double(r));
        if (h < double(r) || std::abs(p.position.x - 1) > a - r) continue;
        middle += flux, narrowInTheMiddle += kind < kPhotonHalvings ? flux : 0;
      }
  }
  const double E = std::sqrt(0.5), rims = 4 * double(a);
  EXPECT_NEAR(wide, E * rims * double(r) * 2 / (3 * double(kPi)), 0.05 * wide);
  EXPECT_LT(leak, 0.8 * wide);
  EXPECT_NEAR(middle, E * std::pow(2 * double(a - r), 2), 0.05 * middle);
  EXPECT_LT(narrowInTheMiddle, 0.05 * middle);
}

}  // namespace
}  // namespace ninefold
