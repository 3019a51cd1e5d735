// sobol.h: four dimensions of the Sobol' sequence, point by index: x_d(i) = C_d i over GF(2).
//
// Dimensions 0 and 1 are a (0,2)-sequence, all four a (3,4)-sequence in base 2. In a (t,s)-sequence
// each aligned block of 2^m indices has 2^t points in every elementary interval of volume 2^(t-m).
//
// Source:  Sobol' 1967; Joe and Kuo 2008 (primitive polynomials and initial numbers).
// Proved:  tests/sampling/sobol_test.cpp (against Boost.Random's sequence; elementary intervals).
// Threads: pure functions.   Errors: none; every 32-bit index is valid.
#pragma once

#include <array>
#include <cstdint>

namespace ninefold {

inline constexpr uint32_t kSobolDimensions = 4;  // joint dimensions of one padded replication

namespace sobol {

// Column j of C_d is the image of index bit j. Column j = m_j 2^(31-j) with the recurrence
// m_j = 2 a_1 m_(j-1) ^ ... ^ 2^s m_(j-s) ^ m_(j-s) of the polynomial x^s + a_1 x^(s-1) + ... + 1.
struct Polynomial {
  int degree;                       // s
  uint32_t inner;                   // a_1 ... a_(s-1) as bits, a_1 first
  std::array<uint32_t, 3> initial;  // m_0 ... m_(s-1), odd
};
inline constexpr std::array<Polynomial, 3> kPolynomials = {
    {{1, 0, {1, 0, 0}}, {2, 1, {1, 3, 0}}, {3, 1, {1, 3, 1}}}};

using Columns = std::array<uint32_t, 32>;

constexpr Columns columns(uint32_t dimension) {
  Columns c{};
  if (dimension == 0) {  // van der Corput: the index with its bits reversed
    for (uint32_t j = 0; j < 32; ++j) c[j] = 0x80000000u >> j;
    return c;
  }
  const Polynomial p = kPolynomials[dimension - 1];
  const auto s = static_cast<uint32_t>(p.degree);
  for (uint32_t j = 0; j < 32; ++j) {
    if (j < s) {
      c[j] = p.initial[j] << (31 - j);
      continue;
    }
    c[j] = c[j - s] ^ (c[j - s] >> s);
    for (uint32_t k = 1; k < s; ++k) {
      if ((p.inner >> (s - 1 - k)) & 1u) c[j] ^= c[j - k];
    }
  }
  return c;
}

// The images of all values of each byte of an index, so that a point costs four look-ups.
using ByteTables = std::array<std::array<uint32_t, 256>, 4>;

constexpr ByteTables byteTables(uint32_t dimension) {
  const Columns c = columns(dimension);
  ByteTables t{};
  for (uint32_t byte = 0; byte < 4; ++byte) {
    for (uint32_t value = 1; value < 256; ++value) {
      const uint32_t low = value & (~value + 1u);  // lowest set bit
      uint32_t bit = 0;
      while ((low >> bit) != 1u) ++bit;
      t[byte][value] = t[byte][value ^ low] ^ c[8 * byte + bit];
    }
  }
  return t;
}

inline constexpr std::array<ByteTables, kSobolDimensions> kTables = {byteTables(0), byteTables(1),
                                                                     byteTables(2), byteTables(3)};

}  // namespace sobol

// Coordinate `dimension` (0..3) of point `index`, as the fraction x / 2^32.
constexpr uint32_t sobolPoint(uint32_t index, uint32_t dimension) {
  const sobol::ByteTables& t = sobol::kTables[dimension];
  return t[0][index & 255u] ^ t[1][(index >> 8) & 255u] ^ t[2][(index >> 16) & 255u] ^
         t[3][index >> 24];
}

}  // namespace ninefold
