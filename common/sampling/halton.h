// halton.h: the Halton sequence, and samples of light paths that stay alike from period to period.
//
//   i       = sum a_j b^j             digits of the index in base b
//   Phi_b(i) = sum a'_j b^(-j-1)       radical inverse; a'_j = (a_j + s_j) mod b
//   s_j       shifts of a replication, by chance; 0: the plain sequence
//
// Period: if N = l b^k, then i and i + m N have the same first k digits, so that
//
//     |Phi_b(i) - Phi_b(i + m N)| < b^-k
//
// and a product of powers of several bases is a period of all of them.
//
//   start of a path       Phi_2: lamp; what is left of it and Phi_3: direction
//                         Phi_11, Phi_13: place on the lamp
//   vertex 1, 2, 3, 4     Phi_5, 17, 23, 31: lobe and survival; what is left of it and
//                         Phi_7, 19, 29, 37: direction
//   all others            plain hashes: long periods would make neighbours alike by chance
//
// Units:   values are multiples of 2^-24 in [0, 1), as all samples; indices below 2^24.
// Source:  Halton 1960; Niederreiter 1992; Dmitriev et al. 2002, 4 (period; one number for an event
//          and what follows it).
// Proved:  tests/sampling/halton_test.cpp.   Threads: const, reentrant.   Errors: none.
#pragma once

#include <array>
#include <cstdint>

#include "common/math/vec.h"
#include "common/sampling/sampler.h"

namespace ninefold {

// b^k with the least k for which values are as fine as floats are.
struct HaltonBase {
  uint32_t base = 2;
  int digits = 24;
  uint64_t power = 1 << 24;

  constexpr explicit HaltonBase(uint32_t b) : base(b), digits(0), power(1) {
    while (power < 1 << 24) power *= b, ++digits;
  }
};

inline constexpr int kMostHaltonDigits = 24;
using DigitShifts = std::array<uint8_t, kMostHaltonDigits>;  // each below the base

// Phi_b(i) b^digits, a whole number. i < b^digits.
constexpr uint64_t radicalInverse(const HaltonBase& b, uint32_t i, const DigitShifts& shifts) {
  uint64_t reversed = 0;
  for (int j = 0; j < b.digits; ++j) {
    const uint32_t rest = i / b.base;
    uint32_t digit = i - rest * b.base + shifts[static_cast<size_t>(j)];
    if (digit >= b.base) digit -= b.base;
    reversed = reversed * b.base + digit;
    i = rest;
  }
  return reversed;
}

// As walkLightPath asks for its numbers (gi/light/light_path.h).
class HaltonSampler {
 public:
  // `seed` tells streams apart; it and `replication` choose the shifts.
  HaltonSampler(uint64_t seed, SampleUse use, uint32_t replication)
      : key_(hashWords(seed, static_cast<uint64_t>(use), replication)) {
    for (size_t d = 0; d < kBases.size(); ++d)
      for (size_t j = 0; j < kMostHaltonDigits; ++j)
        shifts_[d][j] = static_cast<uint8_t>(hashWords(key_, d, j) % kBases[d].base);
  }

  static constexpr uint32_t kWalkDimension = 4;  // of the first vertex

  Vec2 lampAndDirection(uint32_t i) const { return Vec2(value(0, i), value(1, i)); }
  Vec2 place(uint32_t i) const { return Vec2(value(4, i), value(5, i)); }

  // Of the walk.
  float get1D(uint32_t i, uint32_t dimension) const {
    const size_t base = eventBase(dimension);
    return dimension % 4 == 2 && base < kBases.size() ? value(base, i) : hashed(i, dimension);
  }
  Vec2 get2D(uint32_t i, uint32_t dimension) const {
    return Vec2(hashed(i, dimension), hashed(i, dimension + 1));
  }
  // `left`: of the number that chose the D lobe, uniform again.
  Vec2 diffuseDirection(uint32_t i, uint32_t dimension, float left) const {
    const size_t base = eventBase(dimension) + 1;
    return base < kBases.size() ? Vec2(left, value(base, i)) : get2D(i, dimension);
  }

 private:
  static constexpr std::array kBases{HaltonBase(2),  HaltonBase(3),  HaltonBase(5),
                                     HaltonBase(7),  HaltonBase(11), HaltonBase(13),
                                     HaltonBase(17), HaltonBase(19), HaltonBase(23),
                                     HaltonBase(29), HaltonBase(31), HaltonBase(37)};

  // Of the vertex to which a dimension belongs: the first has 5, later ones 17, 23, 31.
  static size_t eventBase(uint32_t dimension) {
    const size_t vertex = dimension / 4;
    return vertex == 1 ? 2 : 2 * vertex + 2;
  }
  float value(size_t d, uint32_t i) const {
    const HaltonBase& b = kBases[d];
    return static_cast<float>((radicalInverse(b, i, shifts_[d]) << 24) / b.power) * 0x1p-24f;
  }
  float hashed(uint32_t i, uint32_t dimension) const {
    const uint64_t place = uint64_t{dimension} << 32 | i;
    return unitFloat(static_cast<uint32_t>(mixWord(key_ + 0x9e3779b97f4a7c15ull * (place + 1))));
  }

  uint64_t key_;
  std::array<DigitShifts, kBases.size()> shifts_{};
};

}  // namespace ninefold
