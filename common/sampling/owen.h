// owen.h: nested uniform (Owen) scrambling of 32-bit fractions, by a hash instead of a stored tree.
//
// Bit k of the result is bit k of x, flipped or not by a hash of the seed and of all higher bits of
// x. So numbers with a common prefix keep a common prefix: elementary intervals are permuted as a
// whole, and every net stays a net. Applied to an index it permutes aligned blocks of 2^j indices.
//
// Source:  Owen 1995; Laine and Karras 2011 (hash on reversed bits); Burley 2020; constants:
//          Vegdahl, "Building a Better LK Hash", 2021.
// Proved:  tests/sampling/owen_test.cpp (prefixes stay together; flips are fair and independent).
// Threads: pure functions.   Errors: none.
#pragma once

#include <cstdint>

namespace ninefold {

constexpr uint32_t reverseBits(uint32_t x) {
  x = __builtin_bswap32(x);
  x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  return ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
}

constexpr uint32_t owenScramble(uint32_t x, uint32_t seed) {
  x = reverseBits(x);
  // In each step a bit depends on itself and lower bits only: carries and products go upwards.
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return reverseBits(x);
}

}  // namespace ninefold
