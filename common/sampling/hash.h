// hash.h: mixes words into one well distributed 64-bit word; the base of all addressed randomness.
// Source:  the finalizer is Stafford's variant 13 of MurmurHash3 (2011), as in SplitMix64
//          (Steele, Lea and Flood 2014).
// Proved:  tests/sampling/hash_test.cpp (each input bit flips each output bit half of the time).
// Threads: pure functions.   Errors: none.
#pragma once

#include <cstdint>

namespace ninefold {

// A bijection of 64-bit words in which every input bit reaches every output bit.
constexpr uint64_t mixWord(uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

// The order of the words counts: hashWords(1, 2) and hashWords(2, 1) are unrelated.
constexpr uint64_t hashWords(uint64_t a, uint64_t b, uint64_t c = 0, uint64_t d = 0) {
  // 2^64 / golden ratio; keeps zeros from staying zero
  constexpr uint64_t kGolden = 0x9e3779b97f4a7c15ull;
  uint64_t h = mixWord(a + kGolden);
  h = mixWord((h ^ b) + kGolden);
  h = mixWord((h ^ c) + kGolden);
  return mixWord((h ^ d) + kGolden);
}

}  // namespace ninefold
