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
// nodes are as many as `nodes`.
Scene twins(Dice& dice, int count, int nodes) {
  std::vector<Mesh> meshes = {cube()};
  for (int i = 0; i < count; ++i) {
    const Mesh cloud = randomTriangles(dice, 1 + dice.below(40), 0.3f, 0.2f);
    meshes.push_back(cloud), meshes.push_back(cloud);
  }
  Scene scene = sceneOf(std::move(meshes));
  for (size_t i = 1; i < scene.instances.size(); ++i) {
    const size_t pair = (i - 1) / 2;
    scene.instances[i].node = 1 + static_cast<int>(pair) % nodes;
    scene.instances[i].toWorld[3] =
        DVec4(0.6 * std::sin(double(pair)), 0.6 * std::cos(2.0 * double(pair)), 0, 1);
  }
  return scene;
}

bool sameBits(const Hit& a, const Hit& b) {
  return a.instance == b.instance && a.triangle == b.triangle && a.u == b.u && a.v == b.v &&
         a.t == b.t;
}

TEST(RayChanges, AnswersAreTheSameAwayFromWhatMoved) {
  uint64_t compared = 0, skipped = 0;
  for (const uint64_t seed : seedsFrom(1, 40)) {
    const Repeatable repeatable(seed);
    Dice dice(seed);
    const int nodes = dice.below(2) == 0 ? 6 : 60;
    const Scene asRead = twins(dice, 30, nodes);
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
      ASSERT_TRUE(
          sameBits(before.closest(origin, direction, 100), now.closest(origin, direction, 100)));
    }
  }
  EXPECT_GT(compared, skipped);
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
