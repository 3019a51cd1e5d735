// quantize.h: single values to small codes with unbiased rounding, and back. Internal to the tile
// codec; tile_codec.h states the bounds.
//
//   code = lower + [u < (v - level(lower)) / (level(lower + 1) - level(lower))]
//
// with u uniform in (0, 1), so that E[level(code)] = v. The levels are those that the decoder gives
// back, exactly. Only sums, products, divisions and square roots are used: the same bits on every
// machine.
// Source: Cigolle et al., "Efficient Representations for Independent Unit Vectors", JCGT 2014 (the
// octahedral code).
// Threads: pure functions.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "common/math/vec.h"

namespace ninefold {

// A bijection that spreads every input bit over all output bits (two multiply-xorshift rounds,
// constants of Stafford's 13th variant).
inline uint64_t mixBits(uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

// Three uniform numbers in (0, 1) of one pixel of one field; 23 bits each. Words of 32 bits
// throughout, so that loops over pixels vectorise. Constants: Wellons, "Prospecting for Hash
// Functions", 2018.
class Dither {
 public:
  // Different for all fields; the high half of a mixed word.
  static uint32_t fieldKey(uint64_t key, uint32_t field) {
    return static_cast<uint32_t>(mixBits(key + (field + 1) * 0x9e3779b97f4a7c15u) >> 32);
  }
  Dither(uint32_t fieldKey, uint32_t pixel) : first_(fieldKey + 3 * pixel) {}
  float operator[](uint32_t i) const {
    uint32_t x = first_ + i;
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    x ^= x >> 16;
    return (static_cast<float>(static_cast<int32_t>(x >> 9)) + 0.5f) * 0x1p-23f;
  }

 private:
  uint32_t first_;
};

// Levels top (q/255)^2: about equal steps to the eye.
class SquareCode {
 public:
  explicit SquareCode(float top) : top_(top), scale_(65025.0f / top) {}
  static float level(int q, float top) { return top * static_cast<float>(q * q) / 65025.0f; }
  // 0 <= v; above the top level it is the top level.
  uint8_t encode(float v, float u) const {
    int q = static_cast<int>(std::min(254.0f, std::sqrt(std::min(v, top_) * scale_)));
    q -= level(q, top_) > v ? 1 : 0;
    const float low = level(q, top_);
    const float part = (v - low) / (level(q + 1, top_) - low);
    return static_cast<uint8_t>(q + (u < part ? 1 : 0));
  }
  float decode(uint8_t code) const { return level(code, top_); }

 private:
  float top_, scale_;
};

// Three mantissas m of 8 bits with one exponent: v = m 2^(e - 135); e = 0 means all are 0. Covers
// all floats from 0 to 255 * 2^120.
struct SharedExponent {
  uint8_t r = 0, g = 0, b = 0, e = 0;

  static constexpr float kLargest = 0x1.fep127f;

  static SharedExponent encode(float r, float g, float b, const Dither& u) {
    r = std::min(r, kLargest), g = std::min(g, kLargest), b = std::min(b, kLargest);
    const auto bits = std::bit_cast<uint32_t>(std::max(r, std::max(g, b)));
    // The smallest scale 2^s, s >= -134, at which the largest component is at most 255.
    const uint32_t exponent = bits >> 23;
    const uint32_t beyond255 = (bits & 0x7fffff) > (exponent == 0 ? 0x7f8000u : 0x7f0000u) ? 1 : 0;
    const uint32_t e = exponent + beyond255 + 1;
    // 2^(135 - e) in two factors: 2^134 is no float.
    const uint32_t half = e / 2, rest = e - half;
    const float first = std::bit_cast<float>((194 - half) << 23);
    const float second = std::bit_cast<float>((195 - rest) << 23);
    return {mantissa(r * first * second, u[0]), mantissa(g * first * second, u[1]),
            mantissa(b * first * second, u[2]), static_cast<uint8_t>(bits == 0 ? 0 : e)};
  }
  // 2^(e - 135), or 0, in two factors that are normal floats; vectorises.
  static float scaleOf(uint8_t e) {
    const uint32_t half = e / 2u, rest = e - half;
    const float scale =
        std::bit_cast<float>((half + 60u) << 23) * std::bit_cast<float>((rest + 59u) << 23);
    return e == 0 ? 0.0f : scale;
  }

 private:
  static uint8_t mantissa(float x, float u) {
    const auto whole = static_cast<int>(x);
    return static_cast<uint8_t>(whole + (u < x - static_cast<float>(whole) ? 1 : 0));
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
    // A quotient of such small integers is exact enough in double to be cut off right.
    const auto offset = static_cast<int32_t>(std::bit_cast<uint32_t>(v) - least_);
    const auto lower = static_cast<uint32_t>(static_cast<int32_t>(offset / double(step_)));
    const float low = level(lower), high = level(lower + 1);
    const uint32_t up = ((v > low) & (u < (v - low) / (high - low))) ? 1 : 0;
    return static_cast<uint16_t>(v == 0 ? 0 : 1 + lower + up);
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

  // Both without branches: they stand in vectorised loops. No vector: 0, or not finite.
  static Octahedral encode(Vec3 n) {
    const float sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    const bool some = (sum > 0) & (sum <= std::numeric_limits<float>::max());
    const Vec2 p(n.x / sum, n.y / sum);
    const Vec2 back = fold(p);
    const bool below = n.z < 0;
    return {some ? nearest(below ? back.x : p.x) : kNone,
            some ? nearest(below ? back.y : p.y) : kNone};
  }
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
  static uint16_t nearest(float p) {
    return static_cast<uint16_t>(static_cast<int32_t>(p * kHalf + kHalf + 0.5f));
  }
};

}  // namespace ninefold
