// Hashed Owen scrambling: nested, fair, and different from one seed to the next.
#include "common/sampling/owen.h"

#include <gtest/gtest.h>

#include <bit>

#include "common/sampling/hash.h"

namespace ninefold {
namespace {

uint32_t random32(uint64_t i) { return static_cast<uint32_t>(hashWords(i, 17)); }

TEST(OwenScramble, NumbersWithACommonPrefixKeepIt) {
  for (uint64_t i = 0; i < 20000; ++i) {
    const uint32_t seed = random32(3 * i), x = random32(3 * i + 1);
    const uint32_t y = x ^ (random32(3 * i + 2) >> (i % 32));
    const int shared = std::countl_zero(x ^ y);
    EXPECT_EQ(std::countl_zero(owenScramble(x, seed) ^ owenScramble(y, seed)), shared);
  }
}

// The flip of bit k below a prefix is a fair coin over the seeds, however many bits are set above.
TEST(OwenScramble, EveryBitFlipsHalfOfTheTime) {
  constexpr int kSeeds = 4096;
  for (const uint32_t x : {0u, 1u, 0x80000000u, 0x12345678u, 0xffffffffu}) {
    for (int bit = 0; bit < 32; ++bit) {
      int flips = 0;
      for (uint64_t s = 0; s < kSeeds; ++s) {
        flips += static_cast<int>(((owenScramble(x, random32(s)) ^ x) >> bit) & 1u);
      }
      EXPECT_NEAR(flips, kSeeds / 2, 160)
          << "x " << x << " bit " << bit;  // five standard deviations
    }
  }
}

// Neighbouring nodes of the scrambling tree flip independently: this separates Owen from XOR.
TEST(OwenScramble, SiblingsFlipIndependently) {
  constexpr int kSeeds = 4096;
  for (int bit = 0; bit < 31; ++bit) {  // the highest bit has no sibling
    for (int above = bit + 1; above < std::min(bit + 6, 32); ++above) {
      int agree = 0;
      for (uint64_t s = 0; s < kSeeds; ++s) {
        const uint32_t x = random32(s + 99999), y = x ^ (1u << above), seed = random32(s);
        const uint32_t flips = (owenScramble(x, seed) ^ x) ^ (owenScramble(y, seed) ^ y);
        agree += static_cast<int>((~flips >> bit) & 1u);
      }
      EXPECT_NEAR(agree, kSeeds / 2, 200) << "bit " << bit << " above " << above;
    }
  }
}

TEST(ReverseBits, IsItsOwnInverseAndMovesEachBit) {
  for (uint32_t bit = 0; bit < 32; ++bit) EXPECT_EQ(reverseBits(1u << bit), 0x80000000u >> bit);
  for (uint64_t i = 0; i < 1000; ++i) EXPECT_EQ(reverseBits(reverseBits(random32(i))), random32(i));
}

}  // namespace
}  // namespace ninefold
