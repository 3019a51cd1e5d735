// The lines of an intersection field. The measure of all lines that meet a surface of area A is
// pi A: of each direction w those over the area A |cos|, and the integral of |cos| dw over half the
// sphere is pi. A convex body of surface S is met by pi S/2 of them (Cauchy, Crofton).
#include "common/gi/intersection_field/line_grid.h"

#include <gtest/gtest.h>

#include "common/math/units.h"
#include "common/sampling/sampler.h"
#include "tests/seeds.h"

namespace ninefold {
namespace {

Bounds roomBounds() {
  Bounds bounds;
  bounds.add(Vec3(-2, -1, -1.5f)), bounds.add(Vec3(3, 1.4f, 1));
  return bounds;
}

template <typename Visit>
void forEachLine(const LineGrid& grid, const Visit& visit) {
  for (uint32_t number = 0; number < grid.lines(); ++number) visit(number, grid.lineOf(number));
}

TEST(LineGrid, NumbersEachLineOnce) {
  const LineGrid grid(roomBounds(), 5, 7);
  EXPECT_EQ(grid.lines(), 2u * 5 * 7 * 2 * 5 * 7);
  forEachLine(grid, [&](uint32_t number, const GridLine& line) {
    ASSERT_EQ(grid.numberOf(line), number);
    ASSERT_LT(line.family, 2);
    ASSERT_TRUE(line.i < 5 && line.j < 7 && line.k < 10 && line.m < 7);
  });
}

// Points of a line lie |D| apart in its direction, and at the places that it has its numbers from.
TEST(LineGrid, HasPointsInALine) {
  const LineGrid grid(roomBounds(), 5, 7);
  forEachLine(grid, [&](uint32_t, const GridLine& line) {
    const Vec3 p = grid.pointAt(line, -0.3f), q = grid.pointAt(line, 0.9f);
    const Vec3 way = grid.directionOf(line) * grid.lengthOf(line) * 1.2f;
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(q[c] - p[c], way[c], 1e-5f);
    const Vec3 at = grid.toFamily(line.family, p);
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(grid.fromFamily(line.family, at)[c], p[c], 1e-6f);
    const LineGrid::Places& b = grid.placesOfB(line.family, line.i);
    ASSERT_NEAR((at.y - grid.slope(line.i) * at.x) * b.scale + b.offset, line.j, 1e-4f);
    const LineGrid::Places& d = grid.placesOfD(line.family, line.k);
    const float c = grid.slope(line.k);
    const float along = grid.isSteep(line.k) ? at.x - c * at.z : at.z - c * at.x;
    ASSERT_NEAR(along * d.scale + d.offset, line.m, 1e-4f);
  });
}

// Directions are those of all space, each once: the solid angle of a line's cell is its measure
// over the area of its (b, d) cell, seen straight on.
TEST(LineGrid, FillsHalfTheSphereWithDirections) {
  const LineGrid grid(roomBounds(), 19, 32);
  double all = 0, up = 0;
  for (int family = 0; family < 2; ++family)
    for (int i = 0; i < 19; ++i)
      for (int k = 0; k < 38; ++k) {
        const GridLine line{family, i, 0, k, 0};
        const double area =
            1 / double{grid.placesOfB(family, i).scale} / double{grid.placesOfD(family, k).scale};
        // The cell lies across u or w.
        const double cosine = 1 / double{grid.lengthOf(line)};
        const double angle = grid.measureOf(line) / (area * cosine);
        all += angle;
        up += angle * double{std::abs(grid.directionOf(line).y)};
      }
  const double pi = double{kPi};
  EXPECT_NEAR(all, 2 * pi, 0.01 * pi);
  EXPECT_NEAR(up, pi, 0.01 * pi);
}

// A disk anywhere, turned in any way: the lines that cross it have the measure pi A.
TEST(LineGrid, MeasuresAreas) {
  const LineGrid grid(roomBounds(), 19, 32);
  for (const uint64_t seed : seedsFrom(1, 6)) {
    const Repeatable repeatable(seed);
    const auto number = [&](uint64_t i) {
      return unitFloat(static_cast<uint32_t>(hashWords(seed, i)));
    };
    const Vec3 centre = Vec3(number(1), number(2), number(3)) - 0.5f;
    Vec3 normal = glm::normalize(Vec3(number(4), number(5), number(6)) - 0.5f);
    if (seed < 4) normal = Vec3(seed == 1, seed == 2, seed == 3);
    const float radius = 0.6f;
    double sum = 0;
    forEachLine(grid, [&](uint32_t, const GridLine& line) {
      const Vec3 p = grid.pointAt(line, 0), way = grid.directionOf(line);
      const float cosine = glm::dot(way, normal);
      if (std::abs(cosine) < 1e-6f) return;
      const Vec3 at = p + glm::dot(centre - p, normal) / cosine * way;
      if (glm::length(at - centre) < radius) sum += grid.measureOf(line);
    });
    const double expected = double{kPi * kPi * radius * radius};
    EXPECT_NEAR(sum, expected, 0.03 * expected);
  }
}

}  // namespace
}  // namespace ninefold
