// The lines through a node of mesh elements stand for its area and for all directions: their
// measure is pi A, and the mean of |cos| over them, weighted by mu, is 2/3, as that of cosine-
// distributed directions.
#include "common/gi/intersection_field/node_lines.h"

#include <gtest/gtest.h>

#include "common/math/units.h"
#include "common/sampling/sampler.h"
#include "common/scene/world.h"
#include "tests/gi/make_scene.h"
#include "tests/gi/render.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

Scene plateInARoom(DMat4 place = DMat4(1)) {
  SceneBuilder b;
  const int grey = b.material(testing::matte(Vec3(0.5f)));
  b.box(grey, Vec3(-1), Vec3(1), true);
  b.quad(grey, Vec3(-0.5f, -0.5f, 0), Vec3(1, 0, 0), Vec3(0, 1, 0));
  Scene scene = b.build();
  scene.instances[1].toWorld = place;
  return scene;
}

DMat4 lyingDown() {
  DMat4 m(1);
  m[1] = DVec4(0, 0, -1, 0), m[2] = DVec4(0, 1, 0, 0);
  return m;
}

DMat4 askew() {
  DMat4 m(1);
  const DVec3 z = glm::normalize(DVec3(0.4, 0.7, -0.5)),
              x = glm::normalize(glm::cross(DVec3(0, 1, 0), z));
  m[0] = DVec4(x, 0), m[1] = DVec4(glm::cross(z, x), 0), m[2] = DVec4(z, 0);
  return m;
}

struct Made {
  Scene scene;
  LineField field;
  ElementBlock block;
  NodeLines lines;

  Made(const Scene& s, const Settings& settings, Metres size)
      : scene(s),
        field(LineGrid(scene.bounds, settings.fieldDirections, settings.fieldDistances), scene,
              nullptr),
        block(scene, std::as_const(scene).meshes[1], DMat3(scene.instances[1].toWorld), size),
        lines(field, scene, 1, block) {}
};

Settings fineLines() {
  Settings s = testing::small(Method::intersectionField);
  s.fieldDirections = 19, s.fieldDistances = 32;
  return s;
}

TEST(NodeLines, HaveTheMeasureOfTheirNodes) {
  for (const DMat4& place : {DMat4(1), lyingDown(), askew()})
    for (const Metres size : {0.36f, 0.1f}) {
      const Made made(plateInARoom(place), fineLines(), size);
      double sum = 0, area = 0, errors = 0;
      for (uint32_t node = 0; node < made.block.nodes(); ++node) {
        const double expected = double{kPi * made.block.area(node)};
        sum += made.lines.measureOf(node), area += expected;
        errors += std::pow(made.lines.measureOf(node) / expected - 1, 2);
      }
      EXPECT_NEAR(sum, area, 0.03 * area) << size;
      const double spread = std::sqrt(errors / static_cast<double>(made.block.nodes()));
      EXPECT_LT(spread, size > 0.2f ? 0.1 : 0.25) << size;
    }
}

TEST(NodeLines, LeaveInAllDirectionsFromAllOfANode) {
  for (const DMat4& place : {DMat4(1), lyingDown(), askew()}) {
    const Made made(plateInARoom(place), fineLines(), 0.3f);
    const Vec3 normal = Vec3(DVec3(place[2]));
    for (uint32_t node = 0; node < made.block.nodes(); ++node) {
      constexpr int kTries = 4000;
      double cosines = 0;
      Vec3 along(0);
      for (int k = 0; k < kTries; ++k) {
        const float u = (static_cast<float>(k) + 0.5f) / kTries;
        const auto start = made.lines.choose(made.field, node, u);
        ASSERT_TRUE(start);
        ASSERT_EQ(start->hit.instance, 1u);
        Vec3 way = made.field.grid().directionOf(start->line);
        if (glm::dot(way, normal) < 0) way = -way;
        cosines += double{glm::dot(way, normal)};
        along += (way - glm::dot(way, normal) * normal) / static_cast<float>(kTries);
        // It starts on the plate.
        const Vec3 p = made.field.grid().pointAt(start->line, start->hit.t);
        ASSERT_LT(std::abs(glm::dot(p, normal)), 1e-4f);
      }
      EXPECT_NEAR(cosines / kTries, 2.0 / 3, 0.08);
      EXPECT_LT(glm::length(along), 0.15f);
    }
  }
}

// With an s-th of the lines the measure is the same, but for the luck of which are left.
TEST(NodeLines, AreThinnedWithoutLoss) {
  Settings s = fineLines();
  s.fieldDirections = 39, s.fieldDistances = 64;
  const Made made(plateInARoom(askew()), s, 0.36f);
  EXPECT_LT(made.lines.bytes(), 18 * NodeLines::kEach * made.block.nodes());
  double sum = 0, area = 0;
  for (uint32_t node = 0; node < made.block.nodes(); ++node)
    sum += made.lines.measureOf(node), area += double{kPi * made.block.area(node)};
  EXPECT_NEAR(sum, area, 0.03 * area);
}

}  // namespace
}  // namespace ninefold
