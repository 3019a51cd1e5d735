// Rays that meet nothing that has changed have the answers that they had, to the last bit, however
// much of the scene lies in the same place twice.
#include "common/tracing/ray_changes.h"

#include <gtest/gtest.h>

#include "common/math/box_rays.h"
#include "common/tracing/tracer.h"
#include "tests/seeds.h"
#include "tests/tracing/make_scene.h"

namespace ninefold {
namespace {

// Each cloud of triangles is there twice, so that each ray meets two triangles at once. Numbers of
// nodes are as many as `nodes`. Glass: one of the two lets light pass, and the other stays when it
// moves.
Scene twins(Dice& dice, int count, int nodes, bool withGlass = false) {
  std::vector<Mesh> meshes = {cube()};
  for (int i = 0; i < count; ++i) {
    const Mesh cloud = randomTriangles(dice, 1 + dice.below(40), 0.3f, 0.2f);
    meshes.push_back(cloud), meshes.push_back(cloud);
    meshes.back().material = withGlass ? 1 : 0;
  }
  Scene scene = sceneOf(std::move(meshes));
  scene.materials.push_back(scene.materials[0]);
  scene.materials[1].alphaMode = AlphaMode::blend, scene.materials[1].opacity = 0.5f;
  for (size_t i = 1; i < scene.instances.size(); ++i) {
    const size_t pair = (i - 1) / 2;
    scene.instances[i].node = 1 + static_cast<int>(withGlass ? i - 1 : pair) % nodes;
    scene.instances[i].toWorld[3] =
        DVec4(0.6 * std::sin(double(pair)), 0.6 * std::cos(2.0 * double(pair)), 0, 1);
  }
  return scene;
}

bool sameBits(const Hit& a, const Hit& b) {
  return a.instance == b.instance && a.triangle == b.triangle && a.u == b.u && a.v == b.v &&
         a.t == b.t;
}

bool sameBits(const SurfacePoint& a, const SurfacePoint& b) {
  return a.position == b.position && a.error == b.error && a.contactCount == b.contactCount;
}

void expectTheSameAway(bool withGlass, double leastShare) {
  uint64_t compared = 0, skipped = 0;
  for (const uint64_t seed : seedsFrom(1, 40)) {
    const Repeatable repeatable(seed);
    Dice dice(seed);
    const int nodes = dice.below(2) == 0 ? 6 : 60;
    const Scene asRead = twins(dice, 30, nodes, withGlass);
    std::vector<bool> moved(asRead.instances.size(), false);
    Scene scene = asRead;
    const int node = 1 + dice.below(nodes);
    for (size_t i = 0; i < moved.size(); ++i)
      if (asRead.instances[i].node == node)
        moved[i] = true, scene.instances[i].toWorld[3].x += 0.05;
    const Tracer before(asRead, Isa::automatic), now(before, scene, moved);
    const auto boxes = rayChanges(*before.answers(), *now.answers());
    ASSERT_TRUE(boxes.has_value());
    for (int i = 0; i < 3000; ++i) {
      const Vec3 origin(dice.uniform(-1, 1), dice.uniform(-1, 1), dice.uniform(-1, 1));
      const Vec3 direction = glm::normalize(
          Vec3(dice.uniform(-1, 1), dice.uniform(-1, 1), dice.uniform(-1, 1)) + 1e-3f);
      const bool isNear = std::ranges::any_of(
          *boxes, [&](const Bounds& box) { return meetsBox(box, origin, direction, 100); });
      if (isNear) {
        ++skipped;
        continue;
      }
      ++compared;
      const Hit was = before.closest(origin, direction, 100);
      const Hit is = now.closest(origin, direction, 100);
      ASSERT_TRUE(sameBits(was, is));
      if (was) {
        ASSERT_TRUE(sameBits(before.surface(was), now.surface(is)));
      }
    }
  }
  EXPECT_GT(double(compared), leastShare * double(compared + skipped));
}

TEST(RayChanges, AnswersAreTheSameAwayFromWhatMoved) { expectTheSameAway(false, 0.5); }

// Also triangles count that a glass no longer touches.
TEST(RayChanges, AnswersAreTheSameAwayFromWhatGlassLeft) { expectTheSameAway(true, 0.15); }

// As if they were not there, also where they share mask bits with others or lie on them.
TEST(Tracer, HidesInstances) {
  for (const uint64_t seed : seedsFrom(100, 119)) {
    const Repeatable repeatable(seed);
    Dice dice(seed);
    const int nodes = dice.below(2) == 0 ? 6 : 60;
    const Scene asRead = twins(dice, 30, nodes, true);
    std::vector<bool> moved(asRead.instances.size(), false), hidden = moved;
    Scene scene = asRead, without = asRead;
    const int movingNode = 1 + dice.below(nodes), hiddenNode = 1 + dice.below(nodes);
    for (size_t i = 0; i < moved.size(); ++i) {
      const int node = asRead.instances[i].node;
      hidden[i] = node == hiddenNode || node == hiddenNode + 7;
      if (node != movingNode && !(hidden[i] && seed % 2 == 0)) continue;
      moved[i] = true, scene.instances[i].toWorld[3].x += 0.05;
    }
    without.instances.clear();
    std::vector<uint32_t> numbers;
    for (uint32_t i = 0; i < hidden.size(); ++i)
      if (!hidden[i]) without.instances.push_back(scene.instances[i]), numbers.push_back(i);
    const Tracer before(asRead, Isa::automatic), all(before, scene, moved), some(all, hidden),
        fewer(std::as_const(without), Isa::automatic);
    const auto answers = some.answers();
    for (uint32_t i = 0; i < hidden.size(); ++i) {
      EXPECT_EQ(answers->shows[i] == nullptr, hidden[i]);
      EXPECT_TRUE(!hidden[i] || answers->touching[i].empty());
    }
    for (int i = 0; i < 2000; ++i) {
      const Vec3 origin(dice.uniform(-1, 1), dice.uniform(-1, 1), dice.uniform(-1, 1));
      const Vec3 direction = glm::normalize(
          Vec3(dice.uniform(-1, 1), dice.uniform(-1, 1), dice.uniform(-1, 1)) + 1e-3f);
      const Hit is = some.closest(origin, direction, 100);
      const Hit expected = fewer.closest(origin, direction, 100);
      ASSERT_EQ(bool(is), bool(expected));
      ASSERT_EQ(some.occluded(origin, direction, 100), bool(expected));
      if (!is) continue;
      ASSERT_FALSE(hidden[is.instance]);
      ASSERT_EQ(is.t, expected.t);
      if (is.instance == numbers[expected.instance] && is.triangle == expected.triangle) {
        ASSERT_TRUE(sameBits(some.surface(is), fewer.surface(expected)));
      }
    }
  }
}

TEST(RayChanges, NothingHasChangedWithoutAnEdit) {
  Dice dice(3);
  const Scene scene = twins(dice, 5, 5);
  const Tracer before(scene, Isa::automatic),
      now(before, scene, std::vector<bool>(scene.instances.size(), false));
  const auto boxes = rayChanges(*before.answers(), *now.answers());
  ASSERT_TRUE(boxes.has_value());
  EXPECT_TRUE(boxes->empty());
}

}  // namespace
}  // namespace ninefold
