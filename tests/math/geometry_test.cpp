// Frames, boxes and rounding bounds.
#include <gtest/gtest.h>

#include <random>

#include "common/math/basis.h"
#include "common/math/bounds.h"
#include "common/math/rounding.h"

namespace ninefold {
namespace {

class Geometry : public testing::Test {
 protected:
  float uniform() { return std::uniform_real_distribution<float>(-1, 1)(engine_); }
  Vec3 vector() { return {uniform(), uniform(), uniform()}; }
  std::mt19937 engine_{7};
};

TEST_F(Geometry, FramesAreOrthonormalAndRightHandedForEveryNormal) {
  std::vector<Vec3> normals = {
      {0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}, glm::normalize(Vec3(1e-6f, 0, -1))};
  for (int i = 0; i < 1000; ++i) normals.push_back(glm::normalize(vector()));
  for (const Vec3& n : normals) {
    const Basis frame(n);
    EXPECT_NEAR(glm::length(frame.tangent), 1, 1e-6f);
    EXPECT_NEAR(glm::length(frame.bitangent), 1, 1e-6f);
    EXPECT_NEAR(glm::dot(frame.tangent, n), 0, 1e-6f);
    EXPECT_NEAR(glm::length(glm::cross(frame.tangent, frame.bitangent) - n), 0, 2e-6f);
    const Vec3 v = vector();
    EXPECT_NEAR(glm::length(frame.toWorld(frame.toLocal(v)) - v), 0, 2e-6f);
    EXPECT_NEAR(frame.toLocal(n).z, 1, 1e-6f);
  }
}

TEST_F(Geometry, BoundsHoldEveryPointAndTheRadiusReachesThem) {
  Bounds bounds;
  EXPECT_TRUE(bounds.empty());
  EXPECT_EQ(bounds.radius(), 0);
  std::vector<Vec3> points;
  for (int i = 0; i < 100; ++i) points.push_back(10.0f * vector() + Vec3(100, 0, -50));
  for (const Vec3& p : points) bounds.add(p);
  EXPECT_FALSE(bounds.empty());
  for (const Vec3& p : points) {
    EXPECT_TRUE(glm::all(glm::lessThanEqual(bounds.low, p)) &&
                glm::all(glm::lessThanEqual(p, bounds.high)));
    EXPECT_LE(glm::length(p - bounds.centre()), bounds.radius() * 1.0001f);
  }
}

TEST_F(Geometry, RoundingAPointMovesItOffItsPlaneByNoMoreThanTheStorageError) {
  for (int i = 0; i < 100000; ++i) {
    const Vec3 n = glm::normalize(vector());
    const DVec3 exact = 1000.0 * DVec3(uniform(), uniform(), uniform()) + DVec3(1e-5 * uniform());
    const Vec3 stored(exact);
    const double moved = std::abs(glm::dot(DVec3(stored) - exact, DVec3(n)));
    ASSERT_LE(moved, 1.000001 * double(storageError(stored, n)));
  }
}

TEST_F(Geometry, TriangleErrorBoundsWhatInterpolationReallyErrs) {
  for (int i = 0; i < 100000; ++i) {
    const Vec3 a = 100.0f * vector(), b = a + vector(), c = a + vector();
    const float u = 0.5f * std::abs(uniform()), v = 0.5f * std::abs(uniform());
    const DVec3 exactN = glm::normalize(exactNormal(a, b, c));
    const Vec3 p = pointOnTriangle(a, b, c, u, v);
    const double off = std::abs(glm::dot(DVec3(p) - DVec3(a), exactN));
    ASSERT_LE(off, double(triangleError(a, b, c, Vec3(exactN), p)));
  }
}

TEST_F(Geometry, AxisAlignedPlanesCostLittleAndNeverNothing) {
  for (int i = 0; i < 1000; ++i) {
    const float height = i % 2 == 0 ? uniform() : 0.0f;
    Vec3 a = 50.0f * vector(), b = 50.0f * vector(), c = 50.0f * vector();
    a.y = b.y = c.y = height;
    const Vec3 p = pointOnTriangle(a, b, c, 0.2f, 0.7f);
    EXPECT_EQ(p.y, height);
    EXPECT_GT(triangleError(a, b, c, {0, 1, 0}, p), 0);
    EXPECT_LE(triangleError(a, b, c, {0, 1, 0}, p), kUnitRoundoff * (std::abs(height) + 100));
  }
}

TEST_F(Geometry, NormalsOfSliversPointTheRightWay) {
  for (int i = 0; i < 1000; ++i) {
    const Vec3 a = vector(), along = vector();
    const Vec3 b = a + along, c = a + 0.5f * along + 1e-6f * vector();
    const DVec3 n = exactNormal(a, b, c);
    EXPECT_NEAR(glm::dot(n, DVec3(b) - DVec3(a)) / (glm::length(n) * glm::length(along)), 0, 1e-8);
    EXPECT_NEAR(glm::dot(n, DVec3(c) - DVec3(a)) / (glm::length(n) * glm::length(along)), 0, 1e-8);
  }
}

}  // namespace
}  // namespace ninefold
