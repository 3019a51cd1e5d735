// packed_flux.h: a flux in four bytes: three mantissas m of eight bits and one exponent.
//
//   flux = m 2^(e - 136)      e chosen so that the largest m is in [128, 255]; 0: nothing
//
// What lies between two mantissas is rounded up with the probability that makes the mean right: a
// million photons of one flux would otherwise all err alike.
//
// Units:   [W].   Proved: tests/gi/group_pages_test.cpp.
// Threads: pure functions.   Errors: none; flux must be finite and not negative.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "common/math/units.h"
#include "common/sampling/hash.h"

namespace ninefold {

inline Flux unpackFlux(uint32_t packed) {
  const int exponent = static_cast<int>(packed >> 24) - 136;
  const auto channel = [&](int shift) {
    return std::ldexp(static_cast<float>(packed >> shift & 255u), exponent);
  };
  return Flux(channel(16), channel(8), channel(0));
}

// `word`: random, tells how to round.
inline uint32_t packFlux(Flux flux, uint64_t word) {
  const float largest = std::max({flux.x, flux.y, flux.z});
  if (!(largest > 0x1p-120f)) return 0;
  int exponent = std::ilogb(largest) - 7;                // of the last bit
  if (std::ldexp(largest, -exponent) > 254) ++exponent;  // rounding up must not overflow
  uint32_t packed = static_cast<uint32_t>(std::min(exponent + 136, 255)) << 24;
  for (int c = 0; c < 3; ++c) {
    const double scaled = std::min(double{std::ldexp(flux[c], -exponent)}, 254.0);
    const double u = static_cast<double>(word >> (40 - 20 * c) & 0xfffffu) * 0x1p-20;
    packed |= static_cast<uint32_t>(scaled + u) << (16 - 8 * c);
  }
  return packed;
}

}  // namespace ninefold
