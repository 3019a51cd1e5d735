// Resampling: what is kept, divided by its probability, has the mean of the sum over all candidates,
// whatever the guess of their worth was.
#include "common/gi/bidirectional/resampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "common/sampling/sampler.h"

namespace ninefold {
namespace {

// `count` numbers in [0, 1), the same for the same seed.
std::vector<float> numbers(size_t count, uint64_t seed) {
  std::vector<float> all;
  for (size_t i = 0; i < count; ++i)
    all.push_back(unitFloat(static_cast<uint32_t>(hashWords(seed, i))));
  return all;
}

// Mean over the whole range of u of sum value/p.
double meanKept(const std::vector<float>& worth, const std::vector<float>& value, int count) {
  constexpr int kSteps = 4096;
  double sum = 0;
  for (int step = 0; step < kSteps; ++step)
    for (const Kept& kept :
         resample(worth, count, (static_cast<float>(step) + 0.5f) / static_cast<float>(kSteps)))
      sum += double{value[kept.index]} * double{kept.gain};
  return sum / kSteps;
}

TEST(Resampling, KeepsTheSumWhateverTheWorth) {
  const std::vector<float> value = numbers(100, 1);
  const double all = std::accumulate(value.begin(), value.end(), 0.0);
  std::vector<float> spiky(100, 0.0f);
  spiky[3] = 1e20f, spiky[70] = 1;
  for (const auto& worth : {value, numbers(100, 2), std::vector<float>(100, 0.0f),
                            std::vector<float>(100, 1e-30f), spiky})
    EXPECT_NEAR(meanKept(worth, value, 9), all, 0.01 * all);
}

TEST(Resampling, KeepsSoManyAndNoneTwice) {
  const std::vector<float> worth = numbers(50, 3);
  for (const float u : numbers(20, 4)) {
    const std::vector<Kept> kept = resample(worth, 7, u);
    EXPECT_NEAR(static_cast<double>(kept.size()), 7, 1);
    for (size_t i = 1; i < kept.size(); ++i) EXPECT_LT(kept[i - 1].index, kept[i].index);
    for (const Kept& each : kept) EXPECT_GE(each.gain, 1);
  }
}

TEST(Resampling, ACandidateWorthMoreThanAPlaceIsKeptForCertain) {
  std::vector<float> worth(40, 0.01f);
  worth[17] = 10;
  for (const float u : numbers(50, 5)) {
    const std::vector<Kept> kept = resample(worth, 5, u);
    const auto found = std::ranges::find(kept, 17u, &Kept::index);
    ASSERT_NE(found, kept.end());
    EXPECT_EQ(found->gain, 1);
  }
}

TEST(Resampling, FewCandidatesAreAllKeptAsTheyAre) {
  const std::vector<Kept> kept = resample(numbers(4, 6), 4, 0.9f);
  ASSERT_EQ(kept.size(), 4u);
  for (const Kept& each : kept) EXPECT_EQ(each.gain, 1);
  EXPECT_TRUE(resample({}, 4, 0.5f).empty());
  EXPECT_TRUE(resample(numbers(4, 6), 0, 0.5f).empty());
}

}  // namespace
}  // namespace ninefold
