// Light profiles against closed forms and quadrature.
//
//   f = 1           Omega = 4 pi
//   f = theta/180   Omega = 2 pi integral of (theta/pi) sin(theta) = 2 pi
#include "common/scene/light_profile.h"

#include <gtest/gtest.h>

#include <random>

#include "common/math/units.h"
#include "common/scene/profile_sampling.h"
#include "tests/sampling/chi_square.h"
#include "tests/scene/one_line_error.h"

namespace ninefold {
namespace {

constexpr double kExactPi = 3.14159265358979323846;
const Vec3 kAxis(0, 0, -1), kAcross(1, 0, 0);

template <typename Value>
LightProfile profileOf(std::vector<float> vertical, std::vector<float> horizontal, Value value) {
  LightProfile p{"test", std::move(vertical), std::move(horizontal), {}};
  for (const float theta : p.vertical)
    for (const float phi : p.horizontal) p.values.push_back(value(theta, phi));
  return p;
}

LightProfile uniform() {
  return profileOf({0, 60, 180}, {0, 120, 360}, [](float, float) { return 1.0f; });
}

// Uneven steps, values at random, a third of them 0.
LightProfile anyProfile(uint32_t seed, std::vector<float> vertical) {
  std::mt19937 random(seed);
  const auto value = [&](float, float) {
    const auto v = static_cast<float>(random() % 1000) / 999;
    return random() % 3 == 0 ? 0.0f : v;
  };
  return profileOf(std::move(vertical), {0, 10, 45, 90, 170, 171, 260, 360}, value);
}

// What a shop would sell: a narrow beam, a wall washer, an uplight.
std::vector<LightProfile> profiles() {
  return {uniform(), anyProfile(1, {0, 5, 30, 31, 90, 150, 180}), anyProfile(2, {90, 120, 180}),
          profileOf({0, 3, 6, 12, 90}, {0, 360},
                    [](float t, float) { return t < 10 ? 1 / (1 + t) : 0; }),
          profileOf({0, 20, 40, 60, 80, 90}, {0, 90, 180, 270, 360},
                    [](float t, float phi) { return phi == 90 ? std::min(1.0f, t / 60) : 0.1f; })};
}

Vec3 direction(double z, double phi) {
  const double r = std::sqrt(std::max(1 - z * z, 0.0));
  return Vec3(DVec3(r * std::cos(phi), r * std::sin(phi), -z));  // z along the axis
}

// Cells of equal solid angle: rings of cos(theta), sectors of phi.
constexpr int kRings = 20, kSectors = 16, kParts = 48;

// By the midpoints of equal steps in both angles.
double integralOver(const LightProfile& p, int ring, int sector) {
  const double from = std::acos(1 - 2.0 * ring / kRings),
               to = std::acos(1 - 2.0 * (ring + 1) / kRings);
  double sum = 0;
  for (int i = 0; i < kParts; ++i)
    for (int j = 0; j < kParts; ++j) {
      const double theta = from + (to - from) * (i + 0.5) / kParts;
      const double phi = 2 * kExactPi * (sector + (j + 0.5) / kParts) / kSectors;
      sum += std::sin(theta) *
             double(profileTowards(p, kAxis, kAcross, direction(std::cos(theta), phi)));
    }
  return sum * (to - from) * 2 * kExactPi / (kSectors * kParts * kParts);
}

TEST(LightProfile, SolidAnglesHaveClosedForms) {
  EXPECT_NEAR(solidAngleOf(uniform()), 4 * kExactPi, 1e-12);
  const auto ramp =
      profileOf({0, 50, 51, 180}, {0, 360}, [](float theta, float) { return theta / 180; });
  EXPECT_NEAR(solidAngleOf(ramp), 2 * kExactPi, 1e-6);
}

TEST(LightProfile, SolidAnglesAreTheIntegral) {
  for (const LightProfile& p : profiles()) {
    double sum = 0;
    for (int i = 0; i < kRings; ++i)
      for (int j = 0; j < kSectors; ++j) sum += integralOver(p, i, j);
    EXPECT_NEAR(solidAngleOf(p), sum, 4e-3 * sum + 1e-6);
    EXPECT_NEAR(ProfileSampling(p).solidAngle(), solidAngleOf(p), 1e-12);
  }
}

TEST(LightProfile, ValuesAreBilinearInTheAngles) {
  const auto p = anyProfile(3, {0, 10, 90});
  for (size_t i = 0; i < p.vertical.size(); ++i)
    for (size_t j = 0; j + 1 < p.horizontal.size(); ++j)
      EXPECT_NEAR(profileAt(p, p.vertical[i], p.horizontal[j]), p.at(i, j), 1e-7f);
  const float expected = 0.25f * (p.at(0, 1) + p.at(0, 2) + p.at(1, 1) + p.at(1, 2));
  EXPECT_NEAR(profileAt(p, 5, 27.5f), expected, 1e-6f);
  EXPECT_EQ(profileAt(p, 90.001f, 10), 0);
  EXPECT_EQ(profileAt(p, 45, -100), profileAt(p, 45, 260));
}

// The horizon belongs to both halves, to the last bit.
TEST(LightProfile, TheHorizonIsAtNinetyDegrees) {
  const auto down = profileOf({0, 90}, {0, 360}, [](float, float) { return 1.0f; });
  const auto up = profileOf({90, 180}, {0, 360}, [](float, float) { return 1.0f; });
  for (int i = 0; i < 64; ++i) {
    const float phi = 0.1f * static_cast<float>(i);
    const Vec3 w(std::cos(phi), std::sin(phi), 0);
    EXPECT_EQ(profileTowards(down, kAxis, kAcross, w), 1);
    EXPECT_EQ(profileTowards(up, kAxis, kAcross, w), 1);
  }
  EXPECT_EQ(profileTowards(down, kAxis, kAcross, Vec3(0, 0, -1)), 1);
  EXPECT_EQ(profileTowards(up, kAxis, kAcross, Vec3(0, 0, -1)), 0);
  EXPECT_EQ(profileTowards(up, kAxis, kAcross, Vec3(0, 0, 1)), 1);
}

// Vertical angles from the axis, horizontal ones from `across`, counterclockwise for who looks
// along the axis from behind: from +X to +Y for an axis of -Z.
TEST(LightProfile, AnglesLieAsTheHeadSays) {
  const auto p = profileOf({0, 90, 180}, {0, 90, 180, 270, 360}, [](float theta, float phi) {
    return theta == 0 ? 0.9f : theta == 180 ? 0.8f : phi == 360 ? 0.0f : phi / 1000;
  });
  const auto to = [&](Vec3 w) { return profileTowards(p, kAxis, kAcross, w); };
  EXPECT_FLOAT_EQ(to(Vec3(0, 0, -1)), 0.9f);
  EXPECT_FLOAT_EQ(to(Vec3(0, 0, 1)), 0.8f);
  EXPECT_NEAR(to(Vec3(1, 0, 0)), 0, 1e-6f);
  EXPECT_NEAR(to(Vec3(0, 1, 0)), 0.09f, 1e-6f);
  EXPECT_NEAR(to(Vec3(-1, 0, 0)), 0.18f, 1e-6f);
  EXPECT_NEAR(to(Vec3(0, -1, 0)), 0.27f, 1e-6f);
  const LightProfile seen = mirrored(p);
  EXPECT_NEAR(profileTowards(seen, kAxis, kAcross, Vec3(0, -1, 0)), 0.09f, 1e-6f);
  EXPECT_NEAR(profileTowards(seen, kAxis, kAcross, Vec3(-1, 0, 0)), 0.18f, 1e-6f);
}

TEST(LightProfile, MirroredTwiceIsItself) {
  const auto p = anyProfile(4, {0, 33, 180});
  const LightProfile twice = mirrored(mirrored(p));
  EXPECT_EQ(twice.values, p.values);
  EXPECT_EQ(twice.horizontal, p.horizontal);
}

TEST(ProfileSampling, DirectionsAreInProportionToTheProfile) {
  constexpr int kSamples = 200'000;
  std::mt19937 random(5);
  const auto u = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
  const auto all = profiles();
  for (size_t k = 0; k < all.size(); ++k) {
    const ProfileSampling sampling(all[k]);
    std::vector<double> seen(kRings * kSectors, 0), expected;
    for (int i = 0; i < kSamples; ++i) {
      const float x = u(), y = u();
      const Vec3 w = sampling.sample(kAxis, kAcross, Vec2(x, y));
      ASSERT_NEAR(glm::length(w), 1, 1e-6f);
      const double phi = std::atan2(double(w.y), double(w.x)) / (2 * kExactPi);
      const int ring = std::min(static_cast<int>((1 + double(w.z)) / 2 * kRings), kRings - 1);
      const int sector =
          std::min(static_cast<int>((phi < 0 ? phi + 1 : phi) * kSectors), kSectors - 1);
      seen[static_cast<size_t>(ring * kSectors + sector)] += 1;
    }
    for (int i = 0; i < kRings; ++i)
      for (int j = 0; j < kSectors; ++j)
        expected.push_back(kSamples * integralOver(all[k], i, j) / sampling.solidAngle());
    EXPECT_GT(chiSquareP(seen, expected), sidak(1e-3, 5)) << "profile " << k;
  }
}

TEST(ProfileSampling, ItsDensityIsTheProfileOverItsSolidAngle) {
  const Vec3 axis = glm::normalize(Vec3(1, -2, 0.5f)), across = acrossAxis(axis, Vec3(0, 0, 1));
  for (const LightProfile& p : profiles()) {
    const ProfileSampling sampling(p);
    for (int i = 0; i < 64; ++i) {
      const Vec2 u(static_cast<float>(i) / 64, static_cast<float>(i * 37 % 64) / 64);
      const Vec3 w = sampling.sample(axis, across, u);
      EXPECT_GT(sampling.pdf(axis, across, w), 0) << i;
      EXPECT_FLOAT_EQ(sampling.pdf(axis, across, w) * static_cast<float>(sampling.solidAngle()),
                      profileTowards(p, axis, across, w));
    }
  }
}

TEST(ProfileSampling, KnowsOnWhichSideMoreIs) {
  EXPECT_NEAR(ProfileSampling(uniform()).shareOnAxisSide(), 0.5, 1e-12);
  EXPECT_EQ(ProfileSampling(anyProfile(2, {90, 120, 180})).shareOnAxisSide(), 0);
  EXPECT_NEAR(ProfileSampling(anyProfile(2, {0, 30, 90})).shareOnAxisSide(), 1, 1e-12);
}

TEST(LightProfile, AcrossAnAxisIsPerpendicularWhateverIsAsked) {
  for (const Vec3 axis : {Vec3(0, 0, -1), Vec3(0, 1, 0), glm::normalize(Vec3(1, 2, 3))})
    for (const Vec3 v : {Vec3(1, 0, 0), Vec3(0, 0, 1), axis, -axis, axis + Vec3(1e-3f, 0, 0)}) {
      const Vec3 across = acrossAxis(axis, v);
      EXPECT_NEAR(glm::length(across), 1, 1e-6f);
      EXPECT_NEAR(glm::dot(across, axis), 0, 1e-6f);
    }
}

TEST(LightProfile, WhatIsNoneIsRefused) {
  const auto refused = [](auto change, const char* part) {
    LightProfile p = uniform();
    change(p);
    EXPECT_CONTAINS(errorOf([&] { checkProfile(p, "it"); }), part);
  };
  checkProfile(uniform(), "it");
  refused([](LightProfile& p) { p.values.pop_back(); }, "8 values for 3 times 3 angles");
  refused([](LightProfile& p) { p.values[3] = -1; }, "a value is -1");
  refused([](LightProfile& p) { p.values[3] = 1.5f; }, "a value is 1.5");
  refused([](LightProfile& p) { p.values[3] = NAN; }, "a value is nan");
  refused([](LightProfile& p) { p.vertical[1] = 0; }, "vertical angle 1 is 0");
  refused([](LightProfile& p) { p.vertical[2] = 181; }, "0 to 180");
  refused([](LightProfile& p) { p.horizontal[1] = NAN; }, "horizontal angle 1 is nan");
  refused([](LightProfile& p) { p.horizontal[2] = 359; }, "from 0 to 360");
  refused([](LightProfile& p) { p.vertical = {0}; }, "1 vertical angles");
  refused([](LightProfile& p) { p.horizontal.clear(); }, "0 horizontal angles");
}

}  // namespace
}  // namespace ninefold
