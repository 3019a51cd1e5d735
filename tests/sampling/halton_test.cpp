#include "common/sampling/halton.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "tests/seeds.h"

namespace ninefold {
namespace {

constexpr DigitShifts kPlain{};
constexpr uint32_t kBases[] = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37};

DigitShifts randomShifts(uint64_t seed, uint32_t base) {
  DigitShifts shifts{};
  for (size_t j = 0; j < shifts.size(); ++j)
    shifts[j] = static_cast<uint8_t>(hashWords(seed, base, j) % base);
  return shifts;
}

TEST(Halton, ReversesTheDigits) {
  // 1234 in base 10 would be 0.4321; 11 = 1011 in base 2 is 0.1101, 1 + 3 + 2 27 = 2011 in base 3.
  const HaltonBase two(2), three(3);
  EXPECT_EQ(radicalInverse(two, 11, kPlain), uint64_t{13} << 20);
  EXPECT_EQ(radicalInverse(three, 58, kPlain), (1 * 27 + 1 * 9 + 0 * 3 + 2) * three.power / 81);
  EXPECT_EQ(radicalInverse(three, 0, kPlain), 0u);
}

// |Phi_b(i) - Phi_b(i + m N)| < b^-k for N = l b^k, in whole numbers, for all bases at once.
TEST(Halton, APeriodLeavesTheFirstDigitsOfAllBasesAsTheyAre) {
  for (const uint64_t seed : seedsFrom(1, 200)) {
    const Repeatable repeatable(seed);
    const int k2 = static_cast<int>(hashWords(seed, 1) % 6),
              k3 = static_cast<int>(hashWords(seed, 2) % 4),
              k5 = static_cast<int>(hashWords(seed, 3) % 2),
              k7 = static_cast<int>(hashWords(seed, 4) % 2);
    const int powers[] = {k2, k3, k5, k7};
    uint32_t period = 1;
    for (int d = 0; d < 4; ++d)
      for (int k = 0; k < powers[d]; ++k) period *= kBases[d];
    const auto i = static_cast<uint32_t>(hashWords(seed, 5) % 100000);
    const auto m = static_cast<uint32_t>(hashWords(seed, 6) % 100);
    for (int d = 0; d < 4; ++d) {
      const HaltonBase base(kBases[d]);
      uint64_t width = base.power;
      for (int k = 0; k < powers[d]; ++k) width /= base.base;
      for (const DigitShifts& shifts : {kPlain, randomShifts(seed, base.base)}) {
        const uint64_t a = radicalInverse(base, i, shifts);
        const uint64_t b = radicalInverse(base, i + m * period, shifts);
        EXPECT_LT(a > b ? a - b : b - a, width) << "base " << base.base << ", period " << period;
        EXPECT_EQ(a / width, b / width);
      }
    }
  }
}

// b^k points, one in each interval of length b^-k, shifted or not.
TEST(Halton, FillsEachIntervalOnce) {
  for (const uint32_t b : kBases) {
    const HaltonBase base(b);
    const uint32_t n = b * b;
    for (const DigitShifts& shifts : {kPlain, randomShifts(3, b)}) {
      std::set<uint64_t> intervals;
      for (uint32_t i = 0; i < n; ++i)
        intervals.insert(radicalInverse(base, 5 * n + i, shifts) / (base.power / n));
      EXPECT_EQ(intervals.size(), n) << b;
    }
  }
}

// Over replications each value is spread evenly: its mean is 1/2, its variance 1/12.
TEST(Halton, ShiftsMakeEachValueUniform) {
  for (const uint32_t i : {0u, 1u, 12345u}) {
    double sum = 0, squares = 0;
    constexpr int kReplicationsHere = 20000;
    for (uint32_t r = 1; r <= kReplicationsHere; ++r) {
      const double x =
          static_cast<double>(HaltonSampler(9, SampleUse::groupPhoton, r).lampAndDirection(i).y);
      sum += x, squares += x * x;
    }
    const double mean = sum / kReplicationsHere;
    EXPECT_NEAR(mean, 0.5, 5 * std::sqrt(1.0 / 12 / kReplicationsHere));
    EXPECT_NEAR(squares / kReplicationsHere - mean * mean, 1.0 / 12, 0.004);
  }
}

// Photons of a group of 288 = 2^5 3^2 leave alike; the first bounce has digits of its own, which
// 10080 = 288 5 7 keeps alike, too.
TEST(Halton, AGroupOfPhotonsStaysTogether) {
  const HaltonSampler sampler(1, SampleUse::groupPhoton, 4);
  const auto spread = [](const std::vector<float>& x) {
    const auto [low, high] = std::minmax_element(x.begin(), x.end());
    return *high - *low;
  };
  for (const auto& [period, bounce] : {std::pair(288u, 1.0f), std::pair(10080u, 1 / 7.0f)}) {
    std::vector<float> lamps, directions, events, turns;
    for (uint32_t m = 0; m < 100; ++m) {
      const Vec2 start = sampler.lampAndDirection(17 + m * period);
      lamps.push_back(start.x), directions.push_back(start.y);
      events.push_back(sampler.get1D(17 + m * period, 6));
      turns.push_back(sampler.diffuseDirection(17 + m * period, 4, 0.5f).y);
    }
    EXPECT_LE(spread(lamps), 1 / 32.0f);
    EXPECT_LE(spread(directions), 1 / 9.0f);
    EXPECT_LE(spread(turns), bounce);
    EXPECT_LE(spread(events), bounce == 1 ? 1 : 1 / 5.0f);
    if (bounce == 1) {
      EXPECT_GT(spread(events), 0.9f);
      EXPECT_GT(spread(turns), 0.9f);
    }
  }
}

}  // namespace
}  // namespace ninefold
