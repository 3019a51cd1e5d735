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

void expectTheSameAway(bool withGlass) {
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
  EXPECT_GT(compared, skipped / 5);
}

TEST(RayChanges, AnswersAreTheSameAwayFromWhatMoved) { expectTheSameAway(false); }

TEST(RayChanges, AnswersAreTheSameAwayFromWhatGlassLeft) { expectTheSameAway(true); }

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
