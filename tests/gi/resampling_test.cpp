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

constexpr Metres kRadius = 2;

std::vector<Kept> resampled(const std::vector<float>& worth, int count, uint64_t key) {
  std::vector<Vec3> positions;
  const std::vector<float> xyz = numbers(3 * worth.size(), 11);
  for (size_t i = 0; i < worth.size(); ++i)
    positions.emplace_back(xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]);
  return resample(worth, positions, count, kRadius, key);
}

// Mean over many keys of sum value/p.
double meanKept(const std::vector<float>& worth, const std::vector<float>& value, int count) {
  constexpr int kKeys = 4096;
  double sum = 0;
  for (uint64_t key = 0; key < kKeys; ++key)
    for (const Kept& kept : resampled(worth, count, key))
      sum += double{value[kept.index]} * double{kept.gain};
  return sum / kKeys;
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
  for (uint64_t key = 0; key < 20; ++key) {
    const std::vector<Kept> kept = resampled(worth, 7, key);
    EXPECT_EQ(kept.size(), 7u);
    for (size_t i = 1; i < kept.size(); ++i) EXPECT_LT(kept[i - 1].index, kept[i].index);
    for (const Kept& each : kept) EXPECT_GE(each.gain, 1);
  }
}

TEST(Resampling, ACandidateWorthMoreThanAPlaceIsKeptForCertain) {
  std::vector<float> worth(40, 0.01f);
  worth[17] = 10;
  for (uint64_t key = 0; key < 50; ++key) {
    const std::vector<Kept> kept = resampled(worth, 5, key);
    const auto found = std::ranges::find(kept, 17u, &Kept::index);
    ASSERT_NE(found, kept.end());
    EXPECT_EQ(found->gain, 1);
  }
}

TEST(Resampling, FewCandidatesAreAllKeptAsTheyAre) {
  const std::vector<Kept> kept = resampled(numbers(4, 6), 4, 9);
  ASSERT_EQ(kept.size(), 4u);
  for (const Kept& each : kept) EXPECT_EQ(each.gain, 1);
  EXPECT_TRUE(resampled({}, 4, 5).empty());
  EXPECT_TRUE(resampled(numbers(4, 6), 0, 5).empty());
}

}  // namespace
}  // namespace ninefold
