// Edits as values: merged, applied, refused.
#include "common/scene/edit.h"

#include <gtest/gtest.h>

#include "common/base/error.h"
#include "tests/scene/simple_scene.h"

namespace ninefold {
namespace {

// Two objects, a lamp.
Scene twoSquares() {
  Scene scene = simpleScene();
  scene.instances[0].node = 3;
  Instance second = scene.instances[0];
  second.node = 8;
  second.toWorld[3] = DVec4(2, 0, 0, 1);
  scene.instances.push_back(second);
  scene.lights.push_back({});
  scene.bounds = {};
  scene.bounds.add(Vec3(-4)), scene.bounds.add(Vec3(4));
  return scene;
}

ObjectEdit moved(int node, DVec3 by) {
  ObjectEdit edit{node, DMat4(1)};
  edit.motion[3] = DVec4(by, 1);
  return edit;
}

std::string errorOf(const Scene& scene, const SceneEdit& edit) {
  try {
    checkEdit(scene, edit);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(SceneEdit, MovesAllInstancesOfANodeAndNothingElse) {
  const Scene scene = twoSquares();
  SceneEdit edit;
  edit.objects.push_back(moved(8, DVec3(0, 1, 0)));
  const Scene after = edited(scene, edit);
  EXPECT_EQ(after.instances[0].toWorld, scene.instances[0].toWorld);
  EXPECT_EQ(DVec3(after.instances[1].toWorld[3]), DVec3(2, 1, 0));
  EXPECT_EQ(movedInstances(scene, edit), (std::vector<bool>{false, true}));
  EXPECT_EQ(&after.meshes[0], &std::as_const(scene).meshes[0]) << "meshes are shared, not copied";
}

TEST(SceneEdit, EditsAreAbsoluteSoThatMergingEqualsFollowing) {
  const Scene scene = twoSquares();
  SceneEdit all;
  for (int i = 1; i <= 10; ++i) {
    SceneEdit step;
    step.objects.push_back(moved(i % 2 == 0 ? 3 : 8, DVec3(0.1 * i, 0, 0)));
    MaterialEdit material = editOfMaterial(scene, 0);
    material.roughness = 0.1f * static_cast<float>(i);
    step.materials.push_back(material);
    merge(all, step);
    merge(all, step);  // twice is once
  }
  ASSERT_EQ(all.objects.size(), 2u);
  EXPECT_EQ(all.objects[0], moved(3, DVec3(1, 0, 0)));
  EXPECT_EQ(all.objects[1].node, 8);
  ASSERT_EQ(all.materials.size(), 1u);
  EXPECT_EQ(edited(scene, all).materials[0].roughness, 1.0f);
}

TEST(SceneEdit, LightsAndMaterialsTakeTheirValues) {
  const Scene scene = twoSquares();
  SceneEdit edit;
  LightEdit light = editOf(scene, 0);
  light.intensity = Vec3(0), light.position = Vec3(1, 2, 3);
  edit.lights.push_back(light);
  MaterialEdit glass = editOfMaterial(scene, 0);
  glass.transmission = 1, glass.ior = 1.3f, glass.baseColor = Vec3(0.2f);
  edit.materials.push_back(glass);
  ASSERT_EQ(errorOf(scene, edit), "");
  const Scene after = edited(scene, edit);
  EXPECT_EQ(editOf(after, 0), light);
  EXPECT_EQ(editOfMaterial(after, 0), glass);
  EXPECT_EQ(editOfMaterial(scene, 0), editOfMaterial(twoSquares(), 0));
}

TEST(SceneEdit, BoundsStayAndWhatHoldsTheSceneGrowsInSteps) {
  const Scene scene = twoSquares();
  const auto movedBy = [&](double x) {
    SceneEdit edit;
    edit.objects.push_back(moved(3, DVec3(x, 0, 0)));
    const Scene after = edited(scene, edit);
    EXPECT_EQ(after.bounds.radius(), scene.bounds.radius());
    EXPECT_EQ(&after.meshes[0], &scene.meshes[0]) << "a mesh that only moves is shared";
    for (const Vec3& p : after.meshes[0].positions) {
      const Vec3 at = worldPoint(after.instances[1].toWorld, p);
      EXPECT_LE(glm::distance(at, after.bounds.centre()), 1.0001f * coverRadius(after));
      EXPECT_LE(at.x, coverBox(after).high.x);
    }
    return after;
  };
  const auto radiusAt = [&](double x) { return coverRadius(movedBy(x)); };
  EXPECT_EQ(radiusAt(1), scene.bounds.radius());
  EXPECT_EQ(radiusAt(1.5), scene.bounds.radius());
  const double outOfTheBoxOnly = 4;  // half of the box is 4 wide, the ball 6.9
  EXPECT_EQ(radiusAt(outOfTheBoxOnly), scene.bounds.radius());
  EXPECT_GT(coverBox(movedBy(outOfTheBoxOnly)).high.x, scene.bounds.high.x);
  EXPECT_EQ(coverBox(movedBy(1)).high, scene.bounds.high);
  EXPECT_GT(radiusAt(8), scene.bounds.radius());
  EXPECT_GT(radiusAt(20), radiusAt(8));
  int steps = 0;
  float last = radiusAt(0);
  for (double x = 0; x < 40; x += 0.1) {
    steps += radiusAt(x) != last ? 1 : 0;
    last = radiusAt(x);
  }
  EXPECT_LE(steps, 11) << "1.25^11 is more than ten times as wide";
}

TEST(SceneEdit, CornersOfTheBoundsLieInTheCover) {
  for (const float size : {0.1f, 1.0f, 3.7f, 1234.5f}) {
    Scene scene = twoSquares();
    scene.bounds = {Vec3(-size), Vec3(size)};
    scene.meshes[0].positions = {Vec3(-size), Vec3(size), Vec3(size, size, -size)};
    SceneEdit edit;
    edit.objects.push_back({.node = 3, .motion = DMat4(1)});
    edit.objects.push_back({.node = scene.instances[0].node, .motion = DMat4(1)});
    scene.instances[0].toWorld = scene.instances[1].toWorld = DMat4(1);
    EXPECT_EQ(coverRadius(edited(scene, edit)), scene.bounds.radius()) << size;
  }
}

TEST(SceneEdit, RefusesWhatIsNotThereOrCannotBe) {
  const Scene scene = twoSquares();
  SceneEdit edit;
  edit.objects.push_back(moved(4, DVec3(0)));
  EXPECT_NE(errorOf(scene, edit).find("object 4"), std::string::npos);
  edit = {};
  edit.objects.push_back(moved(3, DVec3(std::nan(""), 0, 0)));
  EXPECT_NE(errorOf(scene, edit), "");
  edit.objects[0].motion = DMat4(0);
  EXPECT_NE(errorOf(scene, edit), "");
  edit = {};
  edit.lights.push_back({1, Vec3(0), Vec3(0, 0, -1), Vec3(1)});
  EXPECT_NE(errorOf(scene, edit).find("light 1"), std::string::npos);
  edit.lights[0] = {0, Vec3(0), Vec3(0, 0, -2), Vec3(1)};
  EXPECT_NE(errorOf(scene, edit), "");
  edit = {};
  for (int field = 0; field < 5; ++field) {
    MaterialEdit m = editOfMaterial(scene, 0);
    if (field == 0) m.material = 7;
    if (field == 1) m.baseColor.y = 1.5f;
    if (field == 2) m.roughness = -0.1f;
    if (field == 3) m.ior = std::nanf("");
    if (field == 4) m.emission.x = std::numeric_limits<float>::infinity();
    edit.materials = {m};
    EXPECT_NE(errorOf(scene, edit), "") << field;
  }
}

}  // namespace
}  // namespace ninefold
