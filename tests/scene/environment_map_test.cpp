// A picture of all directions: which texel is where, closed forms of its sums, and samples that
// have the density that they claim.
#include "common/scene/environment_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "common/sampling/distribution.h"
#include "tests/sampling/chi_square.h"
#include "tests/scene/one_line_error.h"

namespace ninefold {
namespace {

constexpr double kExactPi = 3.14159265358979323846;

template <typename Value>
EnvironmentPicture pictureOf(int height, Value value, float rotation = 0) {
  EnvironmentPicture p{"--environment FILE", 2 * height, height, {}, rotation};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < p.width; ++x) p.texels.push_back(value(x, y));
  return p;
}

// All dark but for one texel, a million times as bright as the rest.
EnvironmentPicture sunPicture(int x, int y, float rotation = 0) {
  return pictureOf(
      64, [=](int i, int j) { return i == x && j == y ? Vec3(1e6f, 5e5f, 1e5f) : Vec3(1, 2, 3); },
      rotation);
}

Vec3 direction(double theta, double azimuth) {
  return Vec3(DVec3(std::sin(theta) * std::cos(azimuth), std::cos(theta),
                    std::sin(theta) * std::sin(azimuth)));
}

TEST(EnvironmentMap, TheMiddleIsXAndTheTopIsUp) {
  // Red to the right, green downwards.
  const auto ramp = [](int x, int y) {
    return Vec3(static_cast<float>(x), static_cast<float>(y), 0);
  };
  const EnvironmentMap map(pictureOf(8, ramp));
  EXPECT_NEAR(map.towards(Vec3(1, 0, 0)).x, 7.5f, 1e-4f) << "between texels 7 and 8 of 16";
  EXPECT_NEAR(map.towards(Vec3(1, 0, 0)).y, 3.5f, 1e-4f);
  EXPECT_NEAR(map.towards(Vec3(0, 0, 1)).x, 11.5f, 1e-4f) << "a quarter to the right";
  EXPECT_NEAR(map.towards(Vec3(0, 0, -1)).x, 3.5f, 1e-4f);
  EXPECT_NEAR(map.towards(Vec3(-1, 0, 0)).x, 7.5f, 1e-3f) << "between the last and the first";
  EXPECT_NEAR(map.towards(Vec3(0, 1, 0)).y, 0, 1e-4f);
  EXPECT_NEAR(map.towards(Vec3(0, -1, 0)).y, 7, 1e-4f);
}

// Turned by 90 degrees counterclockwise, seen from above, +x comes to lie at -z.
TEST(EnvironmentMap, RotationTurnsItAboutTheVertical) {
  const auto any = [](int x, int y) { return Vec3(static_cast<float>(x * x), float(y), 1); };
  const EnvironmentMap plain(pictureOf(8, any)), turned(pictureOf(8, any, 0.5f * kPi));
  for (double theta = 0.3; theta < 3; theta += 0.31)
    for (double azimuth = 0; azimuth < 6; azimuth += 0.37) {
      const Vec3 w = direction(theta, azimuth), there(w.z, w.y, -w.x);
      EXPECT_NEAR(turned.towards(there).x, plain.towards(w).x, 1e-3f);
      EXPECT_NEAR(turned.towards(there).y, plain.towards(w).y, 1e-3f);
    }
}

// A uniform picture is a constant: value, mean and density, to a millionth.
TEST(EnvironmentMap, AUniformPictureIsTheConstant) {
  const Vec3 value(0.3f, 7, 1e-3f);
  const EnvironmentMap map(pictureOf(
      16, [&](int, int) { return value; }, 0.7f));
  std::mt19937 random(1);
  std::uniform_real_distribution<float> u;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(map.mean()[c], value[c], 1e-6f * value[c]);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 w = map.sample(Vec2(u(random), u(random)));
    EXPECT_EQ(map.towards(w), value);
    EXPECT_NEAR(double{map.pdf(w)}, 1 / (4 * kExactPi), 1e-6 / (4 * kExactPi));
  }
}

// cos^2 theta in the red channel has the mean 1/3; bilinear steps of pi/h add about (pi/h)^2/6.
TEST(EnvironmentMap, TheMeanIsByTheSolidAngle) {
  const EnvironmentMap map(pictureOf(512, [](int, int y) {
    const double c = std::cos((y + 0.5) / 512 * kExactPi);
    return Vec3(static_cast<float>(c * c), c > 0 ? 1.0f : 0.0f, 0);
  }));
  EXPECT_NEAR(map.mean().x, 1.0 / 3, 1e-5);
  EXPECT_NEAR(map.mean().y, 0.5, 1e-6);
  EXPECT_EQ(map.mean().z, 0);
}

// Cells of equal solid angle, against the density's integral by midpoints.
TEST(EnvironmentMap, SamplesHaveTheirDensity) {
  constexpr int kRings = 12, kSectors = 16, kParts = 24, kSamples = 200000;
  for (const auto& picture :
       {pictureOf(6, [](int x, int y) { return Vec3(float(x % 5), float(y), x == 3 ? 9.0f : 0); }),
        pictureOf(
            5, [](int x, int) { return Vec3(x > 4 ? 1.0f : 0.0f); }, 1)}) {
    const EnvironmentMap map(picture);
    std::vector<double> seen(kRings * kSectors + 1), expected(kRings * kSectors + 1);
    const auto cellOf = [](Vec3 w) {
      const double ring = (1 - double{w.y}) / 2 * kRings;
      const double turn = std::atan2(double{w.z}, double{w.x}) / (2 * kExactPi) + 0.5;
      return std::clamp(int(ring), 0, kRings - 1) * kSectors +
             std::clamp(int(turn * kSectors), 0, kSectors - 1);
    };
    for (int i = 0; i < kRings * kParts; ++i)
      for (int j = 0; j < kSectors * kParts; ++j) {
        const double cosine = 1 - 2 * (i + 0.5) / (kRings * kParts);
        const double azimuth = 2 * kExactPi * ((j + 0.5) / (kSectors * kParts) - 0.5);
        const Vec3 w = direction(std::acos(cosine), azimuth);
        expected[static_cast<size_t>(cellOf(w))] +=
            kSamples * 4 * kExactPi * double{map.pdf(w)} / (kRings * kSectors * kParts * kParts);
      }
    std::mt19937 random(3);
    for (int i = 0; i < kSamples; ++i) {
      const auto u = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
      const Vec2 both(u(), u());
      ++seen[static_cast<size_t>(cellOf(map.sample(both)))];
    }
    EXPECT_GT(chiSquareP(seen, expected), 1e-3);
  }
}

// No sample carries much more than the mean, be the sun as bright as it will; their mean is the
// picture's. A million to one on one texel of 8,192.
TEST(EnvironmentMap, ASunDoesNotSparkle) {
  const EnvironmentMap map(sunPicture(40, 20, 2));
  const double bound =
      3 * 4 * kExactPi * double((map.mean().x + map.mean().y + map.mean().z) / 3) / (1 - kAlike);
  DVec3 sum(0);
  constexpr int kSide = 256;
  for (int i = 0; i < kSide * kSide; ++i) {
    const Vec3 w = map.sample(Vec2(i % kSide, i / kSide) / float(kSide));
    const DVec3 carried = DVec3(map.towards(w)) / double{map.pdf(w)};
    for (int c = 0; c < 3; ++c) ASSERT_LE(carried[c], bound * 1.01);
    sum += carried / double(kSide * kSide);
  }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c] / (4 * kExactPi * double{map.mean()[c]}), 1, 5e-3);
}

TEST(EnvironmentMap, BlackIsNoTrouble) {
  const EnvironmentMap map(pictureOf(4, [](int, int) { return Vec3(0); }));
  EXPECT_EQ(map.mean(), Vec3(0));
  EXPECT_EQ(map.towards(Vec3(0, 0, 1)), Vec3(0));
  EXPECT_NEAR(map.pdf(Vec3(0, 0, 1)), 1 / (4 * kExactPi), 1e-6);
}

// From the wire, too.
TEST(EnvironmentMap, WhatIsNoPictureIsRefused) {
  const auto good = pictureOf(4, [](int, int) { return Vec3(1); });
  const auto refused = [&](const std::function<void(EnvironmentPicture&)>& spoil) {
    EnvironmentPicture bad = good;
    spoil(bad);
    return !errorOf([&] { EnvironmentMap map(std::move(bad)); }).empty();
  };
  EXPECT_TRUE(refused([](auto& p) { p.texels.pop_back(); }));
  EXPECT_TRUE(refused([](auto& p) { p.width = 4; }));
  EXPECT_TRUE(refused([](auto& p) { p.width = p.height = 0, p.texels.clear(); }));
  EXPECT_TRUE(refused([](auto& p) { p.width = -8, p.height = -4; }));
  EXPECT_TRUE(refused([](auto& p) { p.width = 1 << 30, p.height = 1 << 29; }));
  EXPECT_TRUE(refused([](auto& p) { p.texels[3].y = NAN; }));
  EXPECT_TRUE(refused([](auto& p) { p.texels[3].x = -1; }));
  EXPECT_TRUE(refused([](auto& p) { p.texels[3].z = INFINITY; }));
  EXPECT_TRUE(refused([](auto& p) { p.rotation = NAN; }));
}

}  // namespace
}  // namespace ninefold
