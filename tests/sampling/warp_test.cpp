// Each warp produces the density that stands beside it.
#include "common/sampling/warp.h"

#include <gtest/gtest.h>

#include <functional>

#include "common/sampling/sampler.h"
#include "tests/sampling/chi_square.h"

namespace ninefold {
namespace {

constexpr int kTests = 10;  // chi-square tests in this file
constexpr uint32_t kSamples = 100000;
constexpr size_t kRows = 12, kColumns = 24;

// Random (not stratified) numbers: chi-square presumes independent samples.
Vec2 randomSquare(uint64_t i) {
  const uint64_t h = hashWords(i, 2026);
  return Vec2(unitFloat(static_cast<uint32_t>(h)), unitFloat(static_cast<uint32_t>(h >> 32)));
}

// Counts samples over kRows x kColumns equal cells of [0,1)^2, where `place` says where a sample
// falls, and compares with `mass`, the probability that each row has (columns are alike).
double rowColumnP(const std::function<Vec2(Vec2)>& place,
                  const std::function<double(double)>& cumulative) {
  std::vector<double> observed(kRows * kColumns), expected;
  for (uint32_t i = 0; i < kSamples; ++i) {
    const Vec2 p = place(randomSquare(i));
    const size_t row = std::min(kRows - 1, static_cast<size_t>(p.x * kRows));
    const size_t column = std::min(kColumns - 1, static_cast<size_t>(p.y * kColumns));
    ++observed[row * kColumns + column];
  }
  for (size_t row = 0; row < kRows; ++row) {
    const double mass = cumulative(double(row + 1) / kRows) - cumulative(double(row) / kRows);
    expected.insert(expected.end(), kColumns, kSamples * mass / kColumns);
  }
  return chiSquareP(observed, expected);
}

float turn(float x, float y) { return 0.5f + std::atan2(y, x) * 0.5f * kInvPi; }

TEST(Warp, DiskIsUniform) {
  const auto place = [](Vec2 u) {
    const Vec2 p = squareToDisk(u);
    EXPECT_LT(glm::length(p), 1.0f + 1e-6f);
    return Vec2(glm::length(p), turn(p.x, p.y));
  };
  EXPECT_GT(rowColumnP(place, [](double r) { return r * r; }), sidak(0.01, kTests));
}

// Rows of cos theta: density cos/pi per solid angle means P(cos < c) = c^2.
TEST(Warp, CosineHemisphereHasItsDensity) {
  const auto place = [](Vec2 u) {
    const Vec3 w = squareToCosineHemisphere(u);
    EXPECT_NEAR(glm::length(w), 1.0f, 1e-6f);
    EXPECT_GT(cosineHemispherePdf(w.z), 0.0f);
    return Vec2(w.z, turn(w.x, w.y));
  };
  EXPECT_GT(rowColumnP(place, [](double c) { return c * c; }), sidak(0.01, kTests));
}

TEST(Warp, SphereIsUniform) {
  const auto place = [](Vec2 u) {
    const Vec3 w = squareToSphere(u);
    EXPECT_NEAR(glm::length(w), 1.0f, 1e-6f);
    return Vec2(0.5f * (1 + w.z), turn(w.x, w.y));
  };
  EXPECT_GT(rowColumnP(place, [](double c) { return c; }), sidak(0.01, kTests));
  EXPECT_FLOAT_EQ(kSpherePdf * 4 * kPi, 1.0f);
}

TEST(Warp, ConesAreUniformEvenIfThin) {
  for (const float oneMinusCos : {2.0f, 1.0f, 0.3f, 1e-3f, 1e-8f}) {
    const auto place = [&](Vec2 u) {
      const Vec3 w = squareToCone(u, oneMinusCos);
      EXPECT_NEAR(glm::length(w), 1.0f, 1e-6f);
      // 1 - cos, from the sine where it is more precise.
      const float sine2 = w.x * w.x + w.y * w.y;
      const float lost = w.z > 0 ? sine2 / (1 + w.z) : 1 - w.z;
      EXPECT_LE(lost, oneMinusCos * (1 + 1e-5f));
      return Vec2(lost / oneMinusCos, turn(w.x, w.y));
    };
    EXPECT_GT(rowColumnP(place, [](double c) { return c; }), sidak(0.01, kTests)) << oneMinusCos;
    EXPECT_NEAR(conePdf(oneMinusCos) * 2 * kPi * oneMinusCos, 1.0f, 1e-6f);
  }
}

// Uniform in a triangle: with s = b1 + b2, P(s < t) = t^2, and b1/s is uniform.
TEST(Warp, TriangleIsUniform) {
  const auto place = [](Vec2 u) {
    const Vec2 b = squareToTriangle(u);
    EXPECT_GE(b.x, 0.0f);
    EXPECT_GE(b.y, 0.0f);
    EXPECT_LE(b.x + b.y, 1.0f);
    const float s = b.x + b.y;
    return Vec2(s, s > 0 ? b.x / s : 0.5f);
  };
  EXPECT_GT(rowColumnP(place, [](double s) { return s * s; }), sidak(0.01, kTests));
}

// Continuity keeps stratification: neighbours go to neighbouring places, with bounded stretch.
TEST(Warp, MapsAreContinuous) {
  constexpr float kStep = 1e-3f;
  for (uint64_t i = 0; i < 20000; ++i) {
    const Vec2 u = randomSquare(i) * (1 - kStep),
               v = u + Vec2(i % 2 ? kStep : 0, i % 2 ? 0 : kStep);
    EXPECT_LT(glm::distance(squareToDisk(u), squareToDisk(v)), 3 * kStep);
    EXPECT_LT(glm::distance(squareToTriangle(u), squareToTriangle(v)), 2 * kStep);
    EXPECT_LT(glm::distance(squareToCone(u, 0.5f), squareToCone(v, 0.5f)), 4 * kStep);
    EXPECT_LT(glm::distance(squareToSphere(u), squareToSphere(v)), 4 * std::sqrt(kStep));
    EXPECT_LT(glm::distance(squareToCosineHemisphere(u), squareToCosineHemisphere(v)),
              3 * std::sqrt(kStep));
  }
}

TEST(Warp, CornersAndCentreAreFinite) {
  const float ends[] = {0.0f, 0x1p-24f, 0.5f - 0x1p-25f, 0.5f, 1.0f - 0x1p-24f};
  for (const float x : ends) {
    for (const float y : ends) {
      EXPECT_TRUE(isFinite(squareToCosineHemisphere({x, y})));
      EXPECT_GT(squareToCosineHemisphere({x, y}).z, 0.0f);
      EXPECT_TRUE(isFinite(squareToSphere({x, y})));
      EXPECT_TRUE(isFinite(squareToCone({x, y}, 1e-8f)));
    }
  }
}

}  // namespace
}  // namespace ninefold
