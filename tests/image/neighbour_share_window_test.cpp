// The share against its definition, summed up pixel by pixel in double: pictures smaller than the
// window, wide patterns, and patterns that are not square.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/image/neighbour_share.h"

namespace ninefold {
namespace {

constexpr int64_t kFrames = 12;

struct Shape {
  int width, height;
  Interleave pattern;
};

// Frames' differences D = F - U: noise of deviation 1, and half of them moved by blur.
struct Differences {
  RgbImage filtered;
  Replications<float> shift;

  Differences(const Shape& shape, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> level(1, 3);
    std::normal_distribution<float> noise;
    filtered.reset(shape.width, shape.height);
    std::vector<float> blur(filtered.count()), frame(filtered.count());
    for (size_t i = 0; i < filtered.count(); ++i) {
      filtered.pixels.r[i] = filtered.pixels.g[i] = filtered.pixels.b[i] = level(random);
      blur[i] = i % 2 == 0 ? level(random) : 0.0f;
    }
    shift.resize(filtered.count());
    for (int64_t n = 0; n < kFrames; ++n) {
      for (size_t i = 0; i < frame.size(); ++i) frame[i] = blur[i] + noise(random);
      shift.add(frame, 0, n);
    }
  }

  NeighbourShare share(Interleave pattern) const {
    return NeighbourShare::of(filtered, shift, kFrames, pattern);
  }
};

struct Expected {
  double share, squaredBias, variance;
};

Expected atPixel(const Differences& d, const Shape& shape, int x, int y) {
  double mean = 0;
  for (size_t i = 0; i < d.filtered.count(); ++i)
    mean += static_cast<double>(luminance(d.filtered.rgb(i))) / double(d.filtered.count());
  const auto scaleOf = [&](size_t i) {
    const auto level = static_cast<double>(luminance(d.filtered.rgb(i)));
    return 1 / (level * level + mean * mean / 100);
  };
  double variance = 0, square = 0, weights = 0;
  for (int v = 0; v < shape.height; ++v)
    for (int u = 0; u < shape.width; ++u) {
      const double weight = std::max(0, shape.pattern.n - std::abs(u - x)) *
                            std::max(0, shape.pattern.m - std::abs(v - y));
      const size_t i = d.filtered.at(u, v);
      const Estimate e = d.shift.estimate(i, kFrames);
      variance += weight * scaleOf(i) * e.squaredError;
      square += weight * scaleOf(i) * e.mean * e.mean;
      weights += weight;
    }
  const double bias = std::max(0.0, square - 2 * variance), a = variance / (variance + bias);
  const double scale = weights * scaleOf(d.filtered.at(x, y));
  return {a, a * a * bias / scale, variance / scale};
}

// Of all pixels together how many have less than the whole.
size_t compare(const Shape& shape, unsigned seed) {
  const Differences d(shape, seed);
  const NeighbourShare found = d.share(shape.pattern);
  size_t partly = 0;
  for (int y = 0; y < shape.height; ++y)
    for (int x = 0; x < shape.width; ++x) {
      const size_t i = d.filtered.at(x, y);
      const Expected e = atPixel(d, shape, x, y);
      EXPECT_NEAR(static_cast<double>(found.share[i]), e.share, 1e-4);
      EXPECT_NEAR(static_cast<double>(found.squaredBias[i]), e.squaredBias, 1e-4 * e.variance);
      partly += e.share < 1;
    }
  return partly;
}

std::string nameOf(const Shape& s) {
  return std::to_string(s.width) + "x" + std::to_string(s.height) + " by " +
         std::to_string(s.pattern.n) + "x" + std::to_string(s.pattern.m);
}

TEST(NeighbourShareWindow, OfTinyPicturesEndsAtTheirBorder) {
  size_t partly = 0;
  for (const Shape& shape : {Shape{1, 1, {3, 3}}, Shape{2, 5, {3, 3}}, Shape{5, 2, {3, 3}},
                             Shape{1, 7, {2, 2}}, Shape{9, 1, {5, 5}}})
    for (unsigned seed = 1; seed <= 20; ++seed) {
      SCOPED_TRACE(nameOf(shape));
      partly += compare(shape, seed);
    }
  EXPECT_GT(partly, 0u);
}

TEST(NeighbourShareWindow, OfTheWidestPatternReachesFifteenPixels) {
  for (const Shape& shape :
       {Shape{1, 1, {16, 16}}, Shape{2, 5, {16, 16}}, Shape{40, 33, {16, 16}}}) {
    SCOPED_TRACE(nameOf(shape));
    EXPECT_GT(compare(shape, 1), 0u);
  }
}

TEST(NeighbourShareWindow, OfAPatternThatIsNotSquareIsAsWideAsThePattern) {
  for (const Shape& shape : {Shape{11, 9, {2, 4}}, Shape{11, 9, {4, 2}}, Shape{11, 9, {1, 5}},
                             Shape{9, 11, {5, 1}}, Shape{2, 5, {16, 1}}, Shape{2, 5, {1, 16}}}) {
    SCOPED_TRACE(nameOf(shape));
    EXPECT_GT(compare(shape, 2), 0u);
  }
}

}  // namespace
}  // namespace ninefold
