// Choice in proportion to weights.
#include "common/sampling/distribution.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/sampling/sampler.h"
#include "tests/seeds.h"

namespace ninefold {
namespace {

std::vector<float> randomWeights(uint32_t n, uint64_t seed) {
  std::vector<float> weights;
  for (uint32_t i = 0; i < n; ++i) {
    const auto h = static_cast<uint32_t>(hashWords(seed, i));
    weights.push_back(h % 3 == 0 ? 0.0f : std::pow(10.0f, 8.0f * unitFloat(h) - 4.0f));
  }
  return weights;
}

TEST(Distribution, ChoosesInProportionAndNeverAZeroWeight) {
  for (const uint64_t seed : seedsFrom(0, 19)) {
    const Repeatable repeatable(seed);
    const std::vector<float> weights = randomWeights(17, seed);
    const Distribution d(weights);
    constexpr uint32_t kGrid = 1u << 16;
    std::vector<double> share(weights.size());
    for (uint32_t i = 0; i < kGrid; ++i) {
      const Distribution::Choice c = d.choose((static_cast<float>(i) + 0.5f) / kGrid);
      ASSERT_GT(weights[c.index], 0.0f);
      ASSERT_EQ(c.probability, d.probability(c.index));
      share[c.index] += 1.0 / kGrid;
    }
    for (uint32_t i = 0; i < weights.size(); ++i) {
      EXPECT_NEAR(share[i], weights[i] / d.total(), 2.0 / kGrid);
      EXPECT_NEAR(d.probability(i), weights[i] / d.total(), 1e-6);
    }
  }
}

TEST(Distribution, RemappedIsUniformInsideEachInterval) {
  const Distribution d({0.0f, 3.0f, 0.0f, 1.0f, 4.0f, 0.0f});
  const float begins[] = {0, 0, 0.375f, 0.375f, 0.5f, 1};
  for (uint32_t i = 0; i < 4096; ++i) {
    const float u = static_cast<float>(i) / 4096;
    const Distribution::Choice c = d.choose(u);
    EXPECT_NEAR(begins[c.index] + c.remapped * c.probability, u + 0x1p-25f, 0x1p-23f);
    EXPECT_GE(c.remapped, 0.0f);
    EXPECT_LT(c.remapped, 1.0f);
  }
}

// One among 100,000 leaves 7 bits for the place inside it: coarse, but neither low nor high on
// average.
TEST(Distribution, RemappedHasTheRightMeanAlsoAmongVeryMany) {
  constexpr uint32_t kCount = 100000, kOne = 31234;
  const Distribution d(std::vector<float>(kCount, 1));
  double sum = 0;
  int found = 0;
  const uint32_t around = static_cast<uint32_t>(0x1p24 * kOne / kCount);
  for (uint32_t i = around - 1000; i < around + 1000; ++i) {
    const Distribution::Choice c = d.choose(static_cast<float>(i) * 0x1p-24f);
    if (c.index != kOne) continue;
    sum += static_cast<double>(c.remapped), ++found;
  }
  EXPECT_NEAR(found, 0x1p24 / kCount, 1);
  EXPECT_NEAR(sum / found, 0.5, 0.25 / found);  // half a step of 1/found would be twice that
}

// 1e-12 of the power is 1/20 of the choices beside one other; nothing stays nothing.
TEST(Distribution, PartlyAlikeFindsTheFaint) {
  const std::vector<double> shares = partlyAlike({1e-6, 0, 1e6});
  EXPECT_NEAR(shares[0], 0.05, 1e-9);
  EXPECT_EQ(shares[1], 0);
  EXPECT_NEAR(shares[2], 0.95, 1e-9);
  EXPECT_EQ(partlyAlike({0, 0}), std::vector<double>({0, 0}));
}

TEST(Distribution, TheEndsOfTheUnitIntervalAreSafe) {
  for (uint64_t seed = 0; seed < 2000; ++seed) {
    const std::vector<float> weights = randomWeights(static_cast<uint32_t>(1 + seed % 7), seed);
    const Distribution d(weights);
    if (d.empty()) continue;
    for (const float u : {0.0f, 0x1p-24f, 0.5f, 1.0f - 0x1p-24f}) {
      const Distribution::Choice c = d.choose(u);
      ASSERT_LT(c.index, weights.size());
      EXPECT_GT(weights[c.index], 0.0f);
      EXPECT_GT(c.probability, 0.0f);
      EXPECT_GE(c.remapped, 0.0f);
      EXPECT_LT(c.remapped, 1.0f);
    }
  }
}

TEST(Distribution, AShareThatNoFloatCanHoldCountsAsZero) {
  const Distribution d({1e-45f, 3e38f, 1e-45f});
  for (const float u : {0.0f, 1.0f - 0x1p-24f}) EXPECT_EQ(d.choose(u).index, 1u);
  EXPECT_EQ(d.probability(0), 0.0f);
  EXPECT_EQ(d.probability(1), 1.0f);
}

TEST(Distribution, WithoutWeightItIsEmpty) {
  EXPECT_TRUE(Distribution().empty());
  EXPECT_TRUE(Distribution(std::vector<float>{}).empty());
  EXPECT_TRUE(Distribution({0.0f, 0.0f}).empty());
  EXPECT_EQ(Distribution({0.0f, 0.0f}).total(), 0.0);
}

TEST(DistributionDeathTest, NegativeAndNonFiniteWeightsAreOurOwnBugs) {
  EXPECT_DEATH(Distribution({1.0f, -1.0f}), "");
  EXPECT_DEATH(Distribution({NAN}), "");
  EXPECT_DEATH(Distribution({INFINITY}), "");
}

}  // namespace
}  // namespace ninefold
