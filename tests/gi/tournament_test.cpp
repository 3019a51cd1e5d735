// The tournament: each candidate is kept as often as its probability says, those kept lie evenly in
// space, and a small change changes few of them.
#include "common/gi/bidirectional/tournament.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace ninefold {
namespace {

constexpr Metres kRadius = 2;

// Their probabilities add up to `sum`. All in one place, or anywhere in a cube of 2 m.
std::vector<Contender> contenders(size_t count, double sum, bool inOnePlace = false) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(-1, 1);
  std::vector<Contender> all;
  double weights = 0;
  for (size_t i = 0; i < count; ++i) {
    const Vec3 position(unit(random), unit(random), unit(random));
    all.push_back({inOnePlace ? Vec3(0.3f) : position, 0.1 + 0.9 * double(i) / double(count)});
    weights += all.back().p;
  }
  for (Contender& each : all) each.p *= sum / weights;
  return all;
}

// Frequency f of n keys with probability p:  |f - p| < 4.5 sqrt(p (1 - p)/n), 100 candidates.
TEST(Tournament, KeepsEachAsOftenAsItsProbabilitySays) {
  for (const bool inOnePlace : {false, true})
    for (const double sum : {1.0, 10.0, 50.0}) {
      const std::vector<Contender> all = contenders(100, sum, inOnePlace);
      std::vector<int> times(all.size(), 0);
      constexpr int kKeys = 20000;
      for (uint64_t key = 0; key < kKeys; ++key)
        for (const uint32_t i : tournament(all, kRadius, key)) ++times[i];
      for (size_t i = 0; i < all.size(); ++i) {
        const double p = all[i].p;
        EXPECT_NEAR(times[i] / double(kKeys), p, 4.5 * std::sqrt(p * (1 - p) / kKeys) + 1e-9)
            << "candidate " << i << ", sum " << sum;
      }
    }
}

// Octants are cells: each keeps as many as its probabilities add up to, within one.
TEST(Tournament, KeepsThemEvenly) {
  const std::vector<Contender> all = contenders(200, 30);
  const auto octant = [&](uint32_t i) {
    const Vec3 p = all[i].position;
    return size_t{p.x > 0} + 2 * size_t{p.y > 0} + 4 * size_t{p.z > 0};
  };
  for (uint64_t key = 0; key < 100; ++key) {
    std::vector<double> more(8, 0);
    for (uint32_t i = 0; i < all.size(); ++i) more[octant(i)] -= all[i].p;
    const std::vector<uint32_t> kept = tournament(all, kRadius, key);
    EXPECT_EQ(kept.size(), 30u);
    for (const uint32_t i : kept) more[octant(i)] += 1;
    for (const double each : more) EXPECT_LT(std::abs(each), 1 + 1e-9);
  }
}

// One that goes, and all probabilities changed by up to 1 %. Drawn anew, 35 of 40 would be others.
TEST(Tournament, ASmallChangeKeepsMostOfThem) {
  const std::vector<Contender> all = contenders(400, 40);
  std::vector<Contender> fewer = all, changed = all;
  fewer.erase(fewer.begin() + 100);
  std::mt19937 random(3);
  for (Contender& each : changed)
    each.p *= std::uniform_real_distribution<double>(0.99, 1.01)(random);
  const auto in = [](const std::vector<uint32_t>& kept, uint32_t i) {
    return std::ranges::find(kept, i) != kept.end();
  };
  double others = 0, othersOfFewer = 0;
  constexpr int kKeys = 50;
  for (uint64_t key = 0; key < kKeys; ++key) {
    const auto before = tournament(all, kRadius, key), after = tournament(changed, kRadius, key);
    const auto without = tournament(fewer, kRadius, key);
    for (const uint32_t i : before) {
      others += in(after, i) ? 0 : 1.0 / kKeys;
      othersOfFewer += in(without, i < 100 ? i : i - 1) ? 0 : 1.0 / kKeys;
    }
  }
  EXPECT_LT(others, 3);
  EXPECT_LT(othersOfFewer, 3);
}

TEST(Tournament, NobodyIsKeptOfNobody) { EXPECT_TRUE(tournament({}, kRadius, 1).empty()); }

}  // namespace
}  // namespace ninefold
