#include <gtest/gtest.h>

#include <cstdint>

#include "common/scene/polygon.h"

namespace ninefold {
namespace {

DVec3 twiceArea(std::span<const Vec3> p, const Triangle& t) {
  return glm::cross(DVec3(p[t.y]) - DVec3(p[t.x]), DVec3(p[t.z]) - DVec3(p[t.x]));
}

// True if the triangles all turn the polygon's way and their areas add up to its own.
void expectTiling(std::span<const Vec3> p, DVec3 normal, double area) {
  const std::vector<Triangle> triangles = triangulate(p);
  EXPECT_EQ(triangles.size(), p.size() - 2);
  double sum = 0;
  for (const Triangle& t : triangles) {
    const double part = 0.5 * glm::dot(twiceArea(p, t), normal);
    EXPECT_GE(part, -1e-9);
    sum += part;
  }
  EXPECT_NEAR(sum, area, 1e-6 * area);
}

TEST(Polygon, ConcaveOnesAreTiledWithoutOverlap) {
  const std::vector<Vec3> arrow = {{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}};
  expectTiling(arrow, DVec3(0, 0, 1), 4);
}

TEST(Polygon, StarsInAnyPlane) {
  for (const DVec3 axis :
       {DVec3(0, 0, 1), DVec3(1, 0, 0), DVec3(0, -1, 0), glm::normalize(DVec3(1, 2, -3))}) {
    const DVec3 u = glm::normalize(glm::cross(axis, DVec3(0.3, 0.9, 0.2)));
    const DVec3 v = glm::cross(axis, u);
    std::vector<Vec3> star;
    constexpr int kPoints = 24;
    for (int i = 0; i < kPoints; ++i) {
      const double angle = 2 * 3.14159265358979 * i / kPoints, radius = i % 2 == 0 ? 3 : 1;
      star.emplace_back(radius * (std::cos(angle) * u + std::sin(angle) * v));
    }
    const double area = 0.5 * kPoints * 3 * 1 * std::sin(2 * 3.14159265358979 / kPoints);
    expectTiling(star, axis, area);
  }
}

TEST(Polygon, LongCombsEndInTime) {
  std::vector<Vec3> comb;  // 500 teeth
  for (int i = 0; i < 500; ++i) {
    comb.emplace_back(2 * i, 0, 0);
    comb.emplace_back(2 * i + 1, 100, 0);
  }
  comb.emplace_back(1000, -1, 0);
  comb.emplace_back(0, -1, 0);
  EXPECT_EQ(triangulate(comb).size(), comb.size() - 2);
}

TEST(Polygon, CrossedAndFlatOnesStillUseAllCorners) {
  const std::vector<Vec3> bow = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(triangulate(bow).size(), 2u);
  const std::vector<Vec3> point(7, Vec3(1, 2, 3));
  EXPECT_EQ(triangulate(point).size(), 5u);
}

}  // namespace
}  // namespace ninefold
