// The codes one by one: bounds, unbiasedness, the ends of their ranges.
#include "proto/quantize.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "common/math/units.h"

namespace ninefold {
namespace {

constexpr int kDithers = 4096;

// Mean of `decoded(dither)` over many dithers must be `value`: a z-test whose standard error is
// measured. |z| > 4.9 happens by chance once in a million times; `floor` is the resolution of the
// dither itself.
template <typename Decoded>
void expectUnbiased(double value, double floor, Decoded decoded) {
  double sum = 0, squares = 0;
  for (uint32_t i = 0; i < kDithers; ++i) {
    const double error = decoded(Dither(Dither::fieldKey(99, 3), i)) - value;
    sum += error, squares += error * error;
  }
  const double mean = sum / kDithers;
  const double variance = std::max(0.0, squares / kDithers - mean * mean);
  EXPECT_LE(std::abs(mean), 4.9 * std::sqrt(variance / kDithers) + floor) << "value " << value;
}

TEST(Quantize, DitherIsUniformAndItsNumbersAreIndependent) {
  // Chi-square over 16 x 16 cells of two of the three numbers: 255 degrees of freedom, 0.1 % tails.
  for (const auto& [a, b] : {std::pair(0, 1), std::pair(1, 2), std::pair(0, 2)}) {
    std::array<int, 256> cells{};
    constexpr int kCount = 256 * 400;
    for (uint32_t i = 0; i < kCount; ++i) {
      const Dither u(Dither::fieldKey(42, 7), i);
      ++cells[static_cast<size_t>(u[a] * 16) * 16 + static_cast<size_t>(u[b] * 16)];
    }
    double chi2 = 0;
    for (const int count : cells) chi2 += (count - 400.0) * (count - 400.0) / 400.0;
    EXPECT_GT(chi2, 190);
    EXPECT_LT(chi2, 330);
  }
}

TEST(Quantize, SquareCodeStaysWithinItsBound) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(0, 1);
  for (const float top : {1.0f, kInvPi}) {
    const SquareCode code(top);
    for (int i = 0; i < 20000; ++i) {
      const float t = i % 2 == 0 ? uniform(random) : uniform(random) * 1e-3f;
      const float v = top * t;
      const float error = std::abs(code.decode(code.encode(v, uniform(random))) - v);
      ASSERT_LE(error, top * (2 * std::sqrt(t) + 1 / 255.0f) / 255 * 1.0001f) << "t = " << t;
    }
    EXPECT_EQ(code.decode(code.encode(0, 0.999f)), 0);
    EXPECT_EQ(code.encode(top * 1.01f, 0.5f), 255);
  }
}

TEST(Quantize, SquareCodeLevelsAreFixedPoints) {
  const SquareCode code(kInvPi);
  for (int q = 0; q < 256; ++q)
    for (const float u : {1e-7f, 0.5f, 0.9999999f})
      EXPECT_EQ(code.encode(code.decode(static_cast<uint8_t>(q)), u), q);
}

TEST(Quantize, SquareCodeIsUnbiased) {
  const SquareCode code(kInvPi);
  std::mt19937 random(2);
  for (int i = 0; i < 200; ++i) {
    const float v = kInvPi * static_cast<float>(random() % 100000) / 100000.0f;
    expectUnbiased(v, 1e-8, [&](Dither u) { return code.decode(code.encode(v, u[0])); });
  }
}

Vec3 decoded(const SharedExponent& c) { return SharedExponent::scaleOf(c.e) * Vec3(c.r, c.g, c.b); }

TEST(Quantize, SharedExponentStaysWithinItsBoundOverAllFloats) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(0, 1);
  for (uint32_t i = 0; i < 100000; ++i) {
    // Any finite bit pattern is as likely as any other: all decades, denormals included.
    const auto v = std::bit_cast<float>(static_cast<uint32_t>(random() % 0x7f7f0000u));
    const Vec3 rgb(v, v * uniform(random), v * uniform(random));
    const Vec3 error = glm::abs(
        decoded(SharedExponent::encode(rgb.x, rgb.y, rgb.z, Dither(Dither::fieldKey(1, 0), i))) -
        rgb);
    ASSERT_LE(double{maxComponent(error)}, std::max(double{v} / 127.5, 0x1p-134)) << v;
  }
}

TEST(Quantize, SharedExponentReachesTheEndsOfItsRange) {
  const Dither u(Dither::fieldKey(1, 2), 3);
  const float largest = SharedExponent::kLargest;
  EXPECT_EQ(decoded(SharedExponent::encode(largest, 0, largest, u)), Vec3(largest, 0, largest));
  const float beyond = std::numeric_limits<float>::max();
  EXPECT_EQ(decoded(SharedExponent::encode(beyond, 1, 0, u)).x, largest);
  EXPECT_EQ(decoded(SharedExponent::encode(0, 0, 0, u)), Vec3(0));
  EXPECT_EQ(decoded(SharedExponent::encode(255, 254, 1, u)), Vec3(255, 254, 1));
  EXPECT_EQ(decoded(SharedExponent::encode(0x1p-134f, 0, 0, u)), Vec3(0x1p-134f, 0, 0));
}

TEST(Quantize, SharedExponentIsUnbiasedFromDenormalsToTheTop) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> uniform(0, 1);
  for (const float size : {1e-43f, 3e-41f, 1e-38f, 1e-6f, 0.1f, 1.0f, 255.5f, 1e6f, 1e30f, 3e38f}) {
    // Far below a level, so few dithers round up that their number is not normal: no test there.
    const float dark = size < 1e-38f ? 0.5f : 0.01f;
    const Vec3 rgb =
        size * Vec3(1, 0.5f + 0.5f * uniform(random), dark * (0.5f + 0.5f * uniform(random)));
    for (int c = 0; c < 3; ++c)
      expectUnbiased(rgb[c], std::max(size * 1e-8, 1e-47), [&](Dither u) {
        return decoded(SharedExponent::encode(rgb.x, rgb.y, rgb.z, u))[c];
      });
  }
}

TEST(Quantize, FloatStepsStayWithinTheBoundAndKeepTheEnds) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform(0, 1);
  for (int range = 0; range < 200; ++range) {
    const float least = std::pow(10.0f, 8 * uniform(random) - 4);
    const float most = least * std::pow(10.0f, 4 * uniform(random));
    const auto low = std::bit_cast<uint32_t>(least), high = std::bit_cast<uint32_t>(most);
    const FloatSteps code(low, high);
    const float step = std::ceil(static_cast<float>(high - low) / 65534.0f);
    for (int i = 0; i < 200; ++i) {
      const float v = std::clamp(least + (most - least) * uniform(random), least, most);
      const float back = code.decode(code.encode(v, uniform(random)));
      ASSERT_LE(std::abs(back - v), v * std::max(step, 1.0f) * 0x1p-23f) << least << " " << most;
      ASSERT_TRUE(back >= least && back <= most);
    }
    EXPECT_EQ(code.decode(code.encode(least, 0.5f)), least);
    EXPECT_EQ(code.decode(code.encode(most, 0.5f)), most);
    EXPECT_EQ(code.decode(code.encode(0, 0.5f)), 0);
  }
}

TEST(Quantize, FloatStepsAreLosslessForShortRanges) {
  const uint32_t low = std::bit_cast<uint32_t>(2.0f);
  const FloatSteps code(low, low + 65534);
  for (uint32_t i = 0; i <= 65534; i += 13) {
    const auto v = std::bit_cast<float>(low + i);
    EXPECT_EQ(code.decode(code.encode(v, 0.5f)), v);
  }
}

TEST(Quantize, FloatStepsNeverLeaveTheFiniteFloats) {
  const uint32_t high = std::bit_cast<uint32_t>(std::numeric_limits<float>::max());
  const FloatSteps code(1, high);
  for (uint32_t c = 0; c <= 65535; c += 5)
    EXPECT_TRUE(std::isfinite(code.decode(static_cast<uint16_t>(c))));
  EXPECT_EQ(code.decode(65535), std::numeric_limits<float>::max());
}

TEST(Quantize, FloatStepsAreUnbiased) {
  const FloatSteps code(std::bit_cast<uint32_t>(0.01f), std::bit_cast<uint32_t>(1000.0f));
  std::mt19937 random(6);
  for (int i = 0; i < 100; ++i) {
    const float v = 0.01f * std::pow(1e5f, static_cast<float>(random() % 1000) / 1000.0f);
    expectUnbiased(v, v * 1e-9, [&](Dither u) { return code.decode(code.encode(v, u[0])); });
  }
}

TEST(Quantize, OctahedralKeepsDirectionsAxesAndZero) {
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  for (int i = 0; i < 100000; ++i) {
    Vec3 n(normal(random), normal(random), normal(random));
    if (i % 4 == 0) n[i / 4 % 3] *= 1e-6f;  // near the folds
    n = glm::normalize(n);
    const Vec3 back = Octahedral::encode(n).decode();
    ASSERT_LE(glm::length(glm::cross(n, back)), 6.5e-5f) << n.x << " " << n.y << " " << n.z;
    ASSERT_GT(glm::dot(n, back), 0);
    ASSERT_NEAR(glm::length(back), 1, 1e-6);
  }
  for (int axis = 0; axis < 3; ++axis)
    for (const float sign : {1.0f, -1.0f}) {
      Vec3 n(0);
      n[axis] = sign;
      EXPECT_EQ(Octahedral::encode(n).decode(), n);
    }
  EXPECT_EQ(Octahedral::encode(Vec3(0)).decode(), Vec3(0));
}

}  // namespace
}  // namespace ninefold
