// Undo and redo, against a copy of every state.
#include "master/interaction/edit_history.h"

#include <gtest/gtest.h>

#include <random>

namespace ninefold {
namespace {

std::shared_ptr<const Scene> someScene() {
  Scene scene;
  scene.materials.resize(3);
  scene.materials[1].roughness = 0.25f;
  scene.lights.resize(2);
  scene.lights[0].intensity = Vec3(7);
  for (int i = 0; i < 4; ++i) scene.instances.push_back({"", 0, i});
  return std::make_shared<const Scene>(scene);
}

bool sameScene(const Scene& a, const Scene& b) {
  bool same = true;
  for (uint32_t i = 0; i < 3; ++i) same = same && editOfMaterial(a, i) == editOfMaterial(b, i);
  for (uint32_t i = 0; i < 2; ++i) same = same && editOf(a, i) == editOf(b, i);
  for (size_t i = 0; i < 4; ++i) same = same && a.instances[i].toWorld == b.instances[i].toWorld;
  return same;
}

SceneEdit randomEdit(const Scene& scene, std::mt19937& random) {
  SceneEdit edit;
  const auto real = [&] { return std::uniform_real_distribution<float>(0, 1)(random); };
  switch (random() % 3) {
    case 0: {
      ObjectEdit object{static_cast<int>(random() % 4), DMat4(1)};
      object.motion[3] = DVec4(double(real()), 0, 0, 1);
      edit.objects.push_back(object);
      break;
    }
    case 1: {
      LightEdit light = editOf(scene, static_cast<uint32_t>(random() % 2));
      light.intensity = Vec3(real());
      edit.lights.push_back(light);
      break;
    }
    default: {
      MaterialEdit material = editOfMaterial(scene, static_cast<uint32_t>(random() % 3));
      material.roughness = real();
      edit.materials.push_back(material);
    }
  }
  return edit;
}

TEST(EditHistory, UndoPassesOverWhatAScriptDid) {
  const auto scene = someScene();
  EditHistory history(scene);
  SceneEdit hand, script;
  hand.lights.push_back(editOf(*scene, 0)), hand.lights[0].intensity = Vec3(1);
  script.lights.push_back(editOf(*scene, 1)), script.lights[0].intensity = Vec3(2);
  history.apply(hand, 1);
  history.follow(script);
  EXPECT_EQ(history.undo()->lights.at(0).intensity, Vec3(7));
  EXPECT_FALSE(history.undo());
  EXPECT_EQ(history.valuesNow(script), script);
}

TEST(EditHistory, UndoAndRedoMeetEveryStateOfARandomSession) {
  const auto scene = someScene();
  Scene read = *scene;
  read.meshes.resize(1);  // without corners: nothing grows
  const auto seen = [&](const EditHistory& h) { return edited(read, h.all()); };
  std::mt19937 random(2);
  EditHistory history(scene);
  std::vector<Scene> states{seen(history)};
  for (uint64_t action = 1; action <= 60; ++action) {
    for (uint32_t i = 0; i <= random() % 4; ++i) history.apply(randomEdit(*scene, random), action);
    states.push_back(seen(history));
  }
  EXPECT_FALSE(history.redo());
  for (size_t at = 60; at > 0; --at) {
    ASSERT_TRUE(history.undo());
    EXPECT_TRUE(sameScene(seen(history), states[at - 1])) << at;
  }
  EXPECT_FALSE(history.undo());
  for (size_t at = 1; at <= 60; ++at) {
    ASSERT_TRUE(history.redo());
    EXPECT_TRUE(sameScene(seen(history), states[at])) << at;
  }
}

TEST(EditHistory, ANewEditForgetsWhatWasTakenBack) {
  const auto scene = someScene();
  std::mt19937 random(4);
  EditHistory history(scene);
  history.apply(randomEdit(*scene, random), 1);
  history.undo();
  history.apply(randomEdit(*scene, random), 2);
  EXPECT_FALSE(history.redo());
  EXPECT_TRUE(history.undo());
  EXPECT_FALSE(history.undo());
}

TEST(EditHistory, WhatChangesByAnUndoIsJustWhatTheActionTouched) {
  const auto scene = someScene();
  EditHistory history(scene);
  SceneEdit edit;
  edit.materials.push_back(editOfMaterial(*scene, 1));
  edit.materials[0].roughness = 0.9f;
  history.apply(edit, 1);
  const auto back = history.undo();
  ASSERT_TRUE(back);
  ASSERT_EQ(back->materials.size(), 1u);
  EXPECT_EQ(back->materials[0].roughness, 0.25f);
  EXPECT_TRUE(back->objects.empty() && back->lights.empty());
}

TEST(EditHistory, AShapeIsTakenBackAndDoneAgain) {
  auto scene = std::make_shared<Scene>(*someScene());
  scene->meshes = {Mesh()};
  scene->meshes[0].positions = {Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  const std::vector<Vec3> read = std::as_const(*scene).meshes[0].positions;
  EditHistory history(scene);
  const auto shape = [&] { return edited(*scene, history.all()).meshes.share(0)->positions; };
  std::vector<std::vector<Vec3>> shapes{read};
  for (uint64_t action = 1; action <= 3; ++action) {
    shapes.push_back(read);
    shapes.back()[1].z = static_cast<float>(action);
    SceneEdit edit;
    edit.shapes = shapeEdits(0, shapes.back(), {});
    history.apply(edit, action);
  }
  for (size_t at = 3; at > 0; --at) {
    ASSERT_TRUE(history.undo());
    EXPECT_EQ(shape(), shapes[at - 1]) << at;
  }
  for (size_t at = 1; at <= 3; ++at) {
    ASSERT_TRUE(history.redo());
    EXPECT_EQ(shape(), shapes[at]) << at;
  }
}

// The number of the last action: undo brings back the one before, and another way on has another.
TEST(EditHistory, TheRevisionTellsWhatIsSaved) {
  auto scene = std::make_shared<Scene>();
  scene->materials.resize(1);
  SceneEdit edit;
  edit.materials.push_back(editOfMaterial(*scene, 0));
  EditHistory history(scene);
  EXPECT_EQ(history.revision(), 0u);
  for (uint64_t action = 1; action <= EditHistory::kMostActions + 5; ++action) {
    history.apply(edit, action);
    EXPECT_EQ(history.revision(), action);
  }
  history.undo();
  EXPECT_EQ(history.revision(), EditHistory::kMostActions + 4);
  history.redo();
  EXPECT_EQ(history.revision(), EditHistory::kMostActions + 5);
  while (history.undo()) {
  }
  EXPECT_EQ(history.revision(), 5u) << "the first that can be undone is the sixth";
  history.follow(edit);
  EXPECT_EQ(history.revision(), 5u) << "a script's doing is nobody's change";
  history.apply(edit, 2000);
  EXPECT_EQ(history.revision(), 2000u);
}

}  // namespace
}  // namespace ninefold
