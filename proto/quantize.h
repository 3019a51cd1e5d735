// quantize.h: single values to small codes with unbiased rounding, and back. Internal to the tile
// codec; tile_codec.h states the bounds.
//
//   code = lower + [u < (v - level(lower)) / (level(lower + 1) - level(lower))],   u uniform in (0,
//   1)
//
// so that E[level(code)] = v. The levels are exactly those that the decoder gives back, and only
// sums, products, divisions and square roots are used: the same bits on every machine. Source of
// the octahedral code: Cigolle et al., "Efficient Representations for Independent Unit Vectors",
// JCGT 2014. Threads: pure functions.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "common/math/vec.h"

namespace ninefold {

// A bijection that spreads every input bit over all output bits (two multiply-xorshift rounds,
// constants of Stafford's 13th variant).
inline uint64_t mixBits(uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

// Three uniform numbers in (0, 1) of one pixel of one field; 21 bits each.
class Dither {
 public:
  Dither(uint64_t key, uint32_t field, uint32_t pixel)
      : bits_(mixBits(key + (uint64_t{field} << 32 | pixel) * 0x9e3779b97f4a7c15u)) {}
  float operator[](int i) const {
    const auto k = static_cast<int32_t>(bits_ >> (21 * i) & 0x1fffff);
    return (static_cast<float>(k) + 0.5f) * 0x1p-21f;
  }

 private:
  uint64_t bits_;
};

// Levels top (q/255)^2: about equal steps to the eye.
class SquareCode {
 public:
  explicit SquareCode(float top) {
    for (int q = 0; q < 256; ++q) level_[static_cast<size_t>(q)] = level(q, top);
    scale_ = 65025.0f / top;
  }
  static float level(int q, float top) { return top * static_cast<float>(q * q) / 65025.0f; }
  // 0 <= v; above the top level it is the top level.
  uint8_t encode(float v, float u) const {
    if (v >= level_[255]) return 255;
    auto q = static_cast<size_t>(std::min(254.0f, std::sqrt(v * scale_)));
    if (level_[q] > v) --q;
    const float part = (v - level_[q]) / (level_[q + 1] - level_[q]);
    return static_cast<uint8_t>(q + (u < part ? 1 : 0));
  }
  float decode(uint8_t code) const { return level_[code]; }

 private:
  std::array<float, 256> level_{};
  float scale_ = 0;
};

// Three mantissas m of 8 bits with one exponent: v = m 2^(e - 135); e = 0 means all are 0. Covers
// all floats from 0 to 255 * 2^120.
struct SharedExponent {
  uint8_t r = 0, g = 0, b = 0, e = 0;

  static constexpr float kLargest = 0x1.fep127f;

  static SharedExponent encode(float r, float g, float b, const Dither& u) {
    r = std::min(r, kLargest), g = std::min(g, kLargest), b = std::min(b, kLargest);
    const auto bits = std::bit_cast<uint32_t>(std::max(r, std::max(g, b)));
    if (bits == 0) return {};
    // The smallest scale 2^s, s >= -134, at which the largest component is at most 255.
    const uint32_t exponent = bits >> 23;
    const uint32_t beyond255 = (bits & 0x7fffff) > (exponent == 0 ? 0x7f8000u : 0x7f0000u) ? 1 : 0;
    const uint32_t e = exponent + beyond255 + 1;
    // In double: 2^134 is no float.
    const double scale = std::bit_cast<double>(uint64_t{1023 + 135 - e} << 52);
    return {mantissa(r * scale, u[0]), mantissa(g * scale, u[1]), mantissa(b * scale, u[2]),
            static_cast<uint8_t>(e)};
  }
  // 2^(e - 135), or 0, in two factors that are normal floats; vectorises.
  static float scaleOf(uint8_t e) {
    const uint32_t half = e / 2u, rest = e - half;
    const float scale =
        std::bit_cast<float>((half + 60u) << 23) * std::bit_cast<float>((rest + 59u) << 23);
    return e == 0 ? 0.0f : scale;
  }

 private:
  static uint8_t mantissa(double x, float u) {
    const auto whole = static_cast<int>(x);
    return static_cast<uint8_t>(whole + (u < static_cast<float>(x - whole) ? 1 : 0));
  }
};

// Codes 1..65535 for the positive floats in [least, most]: equal steps of their bit patterns, which
// is a logarithm in straight pieces. Lossless if the range has at most 65535 floats. Code 0 is 0.
class FloatSteps {
 public:
  // Bit patterns of finite floats, least <= most; both 0 if there is nothing to code.
  FloatSteps(uint32_t least, uint32_t most)
      : least_(least), most_(most), step_(std::max(1u, (most - least + 65533) / 65534)) {}

  uint16_t encode(float v, float u) const {
    if (v == 0) return 0;
    const uint32_t offset = std::bit_cast<uint32_t>(v) - least_;
    const uint32_t lower = offset / step_;
    const float low = level(lower), high = level(lower + 1);
    const bool up = v > low && u < (v - low) / (high - low);
    return static_cast<uint16_t>(1 + lower + (up ? 1 : 0));
  }
  float decode(uint16_t code) const {
    const float value = level(code - 1u);  // whatever it is for code 0
    return code == 0 ? 0.0f : value;
  }

 private:
  float level(uint32_t index) const {
    return std::bit_cast<float>(std::min(least_ + index * step_, most_));
  }
  uint32_t least_, most_, step_;
};

// Unit vectors on an octahedron unfolded to a square of 65535 x 65535 points, so that the six axes
// are exact. The corner that no rounding reaches means "no vector".
struct Octahedral {
  uint16_t x = kNone, y = kNone;

  static constexpr uint16_t kNone = 65535;
  static constexpr float kHalf = 32767;

  static Octahedral encode(Vec3 n) {
    const float sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    if (!(sum > 0)) return {};
    Vec2 p(n.x / sum, n.y / sum);
    if (n.z < 0) p = fold(p);
    return {nearest(p.x), nearest(p.y)};
  }
  // Without branches: it stands in vectorised loops.
  Vec3 decode() const {
    const Vec2 p((static_cast<float>(x) - kHalf) / kHalf, (static_cast<float>(y) - kHalf) / kHalf);
    const Vec2 back = fold(p);
    const float z = 1 - std::abs(p.x) - std::abs(p.y);
    const Vec3 v(z < 0 ? back.x : p.x, z < 0 ? back.y : p.y, z);
    const float scale = 1 / std::sqrt(glm::dot(v, v));
    const bool none = bool(int(x == kNone) | int(y == kNone));
    return {none ? 0 : v.x * scale, none ? 0 : v.y * scale, none ? 0 : v.z * scale};
  }

 private:
  static Vec2 fold(Vec2 p) {
    return Vec2(std::copysign(1 - std::abs(p.y), p.x), std::copysign(1 - std::abs(p.x), p.y));
  }
  static uint16_t nearest(float p) { return static_cast<uint16_t>(p * kHalf + kHalf + 0.5f); }
};

}  // namespace ninefold
