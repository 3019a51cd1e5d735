// The hash behind every sample address: bits spread, and no two addresses meet by accident.
#include "common/sampling/hash.h"

#include <gtest/gtest.h>

#include <bit>
#include <set>

namespace ninefold {
namespace {

TEST(HashWords, EveryInputBitFlipsEveryOutputBitHalfOfTheTime) {
  constexpr int kTrials = 400;
  for (uint32_t word = 0; word < 4; ++word) {
    for (uint32_t bit = 0; bit < 64; ++bit) {
      int flips = 0;
      for (uint64_t trial = 0; trial < kTrials; ++trial) {
        uint64_t in[4] = {trial, 3 * trial, trial + 7,
                          trial ^ 5};  // small numbers, as real addresses are
        const uint64_t before = hashWords(in[0], in[1], in[2], in[3]);
        in[word] ^= uint64_t{1} << bit;
        flips += std::popcount(before ^ hashWords(in[0], in[1], in[2], in[3]));
      }
      // 25600 fair coins: standard deviation 80; six of them, as 256 cases are looked at.
      EXPECT_NEAR(flips, 32 * kTrials, 480) << "word " << word << " bit " << bit;
    }
  }
}

TEST(HashWords, SmallAddressesNeverCollide) {
  std::set<uint64_t> seen;
  constexpr uint64_t kSide = 18;
  for (uint64_t i = 0; i < kSide * kSide * kSide * kSide; ++i) {
    seen.insert(hashWords(i % kSide, i / kSide % kSide, i / (kSide * kSide) % kSide,
                          i / (kSide * kSide * kSide)));
  }
  EXPECT_EQ(seen.size(), kSide * kSide * kSide * kSide);
}

}  // namespace
}  // namespace ninefold
