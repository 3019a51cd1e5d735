// Light as whole numbers: bands of flux, errors of deposits, room for sums.
#include "common/state/fixed_point.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace ninefold {
namespace {

TEST(FixedPoint, BandsAreSixteenOctavesWide) {
  for (int j = -8; j <= 8; ++j) {
    const double low = std::ldexp(1.0, 16 * j), next = std::ldexp(1.0, 16 * j + 16);
    EXPECT_EQ(fluxBand(low), j);
    EXPECT_EQ(fluxBand(1.5 * low), j);
    EXPECT_EQ(fluxBand(std::nextafter(next, 0)), j);
    EXPECT_EQ(fluxBand(next), j + 1);
  }
  EXPECT_EQ(fluxQuantum(0), 0x1p-40);
  EXPECT_EQ(fluxQuantum(-1), 0x1p-56);
  EXPECT_EQ(fluxQuantum(2), 0x1p-8);
}

// A photon of 2^20 has at least 2^20 quanta, all of the flux at most 2^56.
TEST(FixedPoint, PhotonsAreFineAndSumsHaveRoom) {
  for (double flux = 0x1p-100; flux < 0x1p100; flux *= 1.37) {
    const double u = fluxQuantum(fluxBand(flux));
    const int64_t photon = toFixed(flux * 0x1p-20, u), all = toFixed(flux, u);
    EXPECT_GE(photon, int64_t{1} << 20);
    EXPECT_LE(all, int64_t{1} << 56);
    EXPECT_LE(std::abs(fromFixed(photon, u) / (flux * 0x1p-20) - 1), 0x1p-21);
    int64_t sum = 0;
    for (int i = 0; i < 127; ++i) ASSERT_FALSE(__builtin_add_overflow(sum, all, &sum));
  }
}

TEST(FixedPoint, RoundsToTheNearestAndAlikeForBothSigns) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 1000; ++i) {
    const double x = std::ldexp(uniform(random), static_cast<int>(random() % 30));
    const int64_t n = toFixed(x, kWeightQuantum);
    EXPECT_LE(std::abs(fromFixed(n, kWeightQuantum) - x), kWeightQuantum / 2);
    EXPECT_EQ(toFixed(-x, kWeightQuantum), -n);
  }
  EXPECT_EQ(toFixed(1, kWeightQuantum), int64_t{1} << 32);
}

TEST(FixedPoint, WhatIsNotFiniteOrTooLargeIsRefused) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {infinity, -infinity, std::nan(""), 0x1p62, -0x1p62, 1e300})
    EXPECT_THROW(toFixed(bad, 1), Error) << bad;
  EXPECT_EQ(toFixed(std::nextafter(0x1p62, 0), 1), (int64_t{1} << 62) - 512);
}

}  // namespace
}  // namespace ninefold
