// Scripts: what they say at a time, and what is wrong with bad ones.
#include "master/running/playback.h"

#include <gtest/gtest.h>

#include "common/base/error.h"
#include "common/scene/world.h"

namespace ninefold {
namespace {

Scene someScene() {
  Scene scene;
  Mesh mesh;
  mesh.positions = {Vec3(-1, 0, -1), Vec3(1, 0, -1), Vec3(1, 2, 1)};
  mesh.triangles = {Triangle(0, 1, 2)};
  scene.meshes = {mesh};
  Material ball;
  ball.name = "glass";
  scene.materials = {ball};
  scene.instances = {{"ball", 0, 2}, {"ball", 0, 5}, {"table", 0, 7}};
  PunctualLight lamp;
  lamp.name = "lamp", lamp.intensity = Vec3(4);
  scene.lights = {lamp};
  Camera camera;
  camera.name = "front";
  scene.cameras = {camera};
  scene.bounds = boundsOf(scene);
  return scene;
}

std::string errorOf(const std::string& text) {
  try {
    parseScript(text, "s.json", someScene());
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(Script, ThingsMoveEvenlyAndStayWhereTheyWerePut) {
  const Scene scene = someScene();
  const Script script = parseScript(R"({"seconds": 4, "events": [
      {"from": 1, "to": 3, "object": "ball", "by": [2, 0, 0]},
      {"at": 3.5, "object": "ball", "by": [0, 1, 0]}]})",
                                    "s.json", scene);
  const auto placeAt = [&](double time) {
    const SceneEdit edit = script.at(time, scene, {}).edit;
    if (edit.objects.empty()) return DVec3(0);
    EXPECT_EQ(edit.objects.size(), 2u) << "all objects of the name";
    return DVec3(edit.objects[0].motion[3]);
  };
  EXPECT_EQ(placeAt(0.9), DVec3(0));
  EXPECT_NEAR(glm::length(placeAt(1.5) - DVec3(0.5, 0, 0)), 0, 1e-12);
  EXPECT_NEAR(glm::length(placeAt(3.2) - DVec3(2, 0, 0)), 0, 1e-12);
  EXPECT_NEAR(glm::length(placeAt(4) - DVec3(2, 1, 0)), 0, 1e-12);
}

// A mesh of several objects changes once; what comes later goes on from there.
TEST(Script, ThingsAreTwistedAtTheTopAgainstTheFoot) {
  const Scene scene = someScene();
  const Script script = parseScript(R"({"seconds": 4, "events": [
      {"from": 0, "to": 2, "object": "ball", "twist": 90, "by": [1, 0, 0]},
      {"at": 3, "object": "ball", "twist": 90}]})",
                                    "s.json", scene);
  const auto topAt = [&](double time) {
    const SceneEdit edit = script.at(time, scene, {}).edit;
    EXPECT_EQ(edit.shapes.size(), 1u);
    EXPECT_EQ(edit.shapes[0].vertices->positions[0], Vec3(-1, 0, -1)) << "the foot stays";
    return edit.shapes[0].vertices->positions[2];
  };
  const auto expectAt = [&](double time, Vec3 top) {
    EXPECT_NEAR(glm::length(topAt(time) - top), 0, 1e-5f) << time;
  };
  expectAt(1, Vec3(std::sqrt(2.0f), 2, 0));
  expectAt(2, Vec3(1, 2, -1));
  expectAt(3, Vec3(-1, 2, -1));
  EXPECT_EQ(script.at(1, scene, {}).edit.objects.size(), 2u);
}

TEST(Script, AScriptPlayerSendsShapesOnceAndTakesThemBack) {
  const auto scene = std::make_shared<const Scene>(someScene());
  ScriptPlayer player(parseScript(R"({"seconds": 9, "events": [
      {"from": 1, "to": 2, "object": "ball", "twist": 90}]})",
                                  "s.json", *scene),
                      scene, {});
  EXPECT_TRUE(player.moveTo(0.5).edit.shapes.empty());
  EXPECT_EQ(player.moveTo(1.5).edit.shapes.size(), 1u);
  EXPECT_EQ(player.moveTo(2).edit.shapes.size(), 1u);
  EXPECT_TRUE(player.moveTo(3).edit.shapes.empty()) << "nothing has changed since";
  const SceneEdit back = player.moveTo(0.5).edit;
  ASSERT_EQ(back.shapes.size(), 1u);
  EXPECT_EQ(back.shapes[0], editOfShape(*scene, {0, 0})) << "as it was read";
}

TEST(Script, ObjectsTurnAboutTheirMiddle) {
  const Scene scene = someScene();
  const Script script = parseScript(
      R"({"seconds": 1, "events": [{"at": 0, "object": "table", "turn": 90}]})", "s.json", scene);
  const DMat4 motion = script.at(0, scene, {}).edit.objects.at(0).motion;
  EXPECT_NEAR(glm::length(DVec3(motion * DVec4(0, 1, 0, 1)) - DVec3(0, 1, 0)), 0, 1e-12);
  EXPECT_NEAR(glm::length(DVec3(motion * DVec4(1, 1, 0, 1)) - DVec3(0, 1, -1)), 0, 1e-12);
}

TEST(Script, CamerasLightsAndMaterialsGoFromWhatTheyWere) {
  const Scene scene = someScene();
  const Script script = parseScript(R"({"seconds": 2, "rate": 10, "frames": 3, "events": [
      {"from": 0, "to": 2, "camera": ["0,0,0:0,0,-1:40", "2,0,0:2,0,-1:40", "2,0,4:2,0,0:60"]},
      {"from": 0, "to": 1, "light": "lamp", "intensity": [0, 0, 0]},
      {"from": 1, "to": 2, "light": "lamp", "intensity": [2, 2, 2]},
      {"at": 1, "material": "glass", "roughness": 0.25}]})",
                                    "s.json", scene);
  EXPECT_EQ(script.pictures(), 21);
  EXPECT_EQ(script.frames, 3);
  EXPECT_NEAR(script.at(0.5, scene, {}).camera.eye.x, 1, 1e-6f);
  EXPECT_NEAR(script.at(1.5, scene, {}).camera.eye.z, 2, 1e-6f);
  EXPECT_NEAR(script.at(0.5, scene, {}).edit.lights.at(0).intensity.x, 2, 1e-6f);
  EXPECT_NEAR(script.at(1.5, scene, {}).edit.lights.at(0).intensity.x, 1, 1e-6f);
  EXPECT_TRUE(script.at(0.9, scene, {}).edit.materials.empty());
  EXPECT_EQ(script.at(1, scene, {}).edit.materials.at(0).roughness, 0.25f);
}

// Node 7 goes up by 1 m a second for two seconds.
Scene movingScene() {
  Scene scene = someScene();
  AnimatedNode table;
  table.node = 7, table.hasInstances = true;
  table.translation = {AnimationTrack::Kind::linear, {0, 2}, {DVec4(0), DVec4(0, 2, 0, 0)}};
  table.rotation = {AnimationTrack::Kind::step, {0}, {DVec4(0, 0, 0, 1)}};
  table.scale = {AnimationTrack::Kind::step, {0}, {DVec4(1)}};
  scene.animated.push_back(table);
  return scene;
}

TEST(Script, PlaysTheFilesAnimation) {
  const Scene scene = movingScene();
  const Script script = parseScript(
      R"({"seconds": 4, "events": [{"from": 1, "to": 2, "animation": [0.5, 2]},
                                   {"at": 3, "object": "table", "by": [0, 0, 5]}]})",
      "s.json", scene);
  EXPECT_TRUE(script.at(0.9, scene, {}).edit.empty());
  const auto place = [&](double t) {
    return DVec3(script.at(t, scene, {}).edit.objects.at(0).motion[3]);
  };
  EXPECT_EQ(place(1), DVec3(0, 0.5, 0));
  EXPECT_EQ(place(1.5), DVec3(0, 1.25, 0));
  EXPECT_EQ(place(3), DVec3(0, 2, 5));
}

TEST(Script, AnimateIsAScriptOfOneEvent) {
  const Scene scene = movingScene();
  const Script script = playedAnimation({0.5, 1.5, 4}, 6, scene);
  EXPECT_EQ(script.pictures(), 5);
  EXPECT_EQ(script.frames, 6);
  EXPECT_EQ(DVec3(script.at(0.25, scene, {}).edit.objects.at(0).motion[3]), DVec3(0, 0.75, 0));
  EXPECT_THROW(playedAnimation({0, 1, 25}, 6, someScene()), Error);
}

TEST(ScriptPlayer, TellsOnlyWhatIsDifferent) {
  const auto scene = std::make_shared<const Scene>(movingScene());
  ScriptPlayer player(parseScript(R"({"seconds": 9, "events": [
      {"at": 1, "object": "ball", "by": [1, 0, 0]}, {"from": 2, "to": 4, "animation": [0, 2]},
      {"at": 3, "camera": ["0,0,0:0,0,-1:40"]}]})",
                                  "s.json", *scene),
                      scene, scene->cameras[0]);
  EXPECT_TRUE(player.moveTo(0).edit.empty());
  EXPECT_EQ(player.moveTo(1).edit.objects.size(), 2u);
  EXPECT_TRUE(player.moveTo(1.5).edit.empty());
  EXPECT_FALSE(player.moveTo(2.5).camera);
  const ScriptPlayer::Step step = player.moveTo(3);
  ASSERT_EQ(step.edit.objects.size(), 1u);
  EXPECT_EQ(step.edit.objects[0].node, 7);
  EXPECT_TRUE(step.camera);
  EXPECT_FALSE(player.moveTo(3.5).camera);
}

TEST(ScriptPlayer, GoesBackToo) {
  const auto scene = std::make_shared<const Scene>(movingScene());
  ScriptPlayer player(
      parseScript(
          R"({"seconds": 9, "events": [{"at": 1, "material": "glass", "roughness": 0.25}]})",
          "s.json", *scene),
      scene, scene->cameras[0]);
  EXPECT_EQ(player.moveTo(2).edit.materials.at(0).roughness, 0.25f);
  EXPECT_EQ(player.moveTo(0).edit.materials.at(0), editOfMaterial(*scene, 0));
  EXPECT_TRUE(player.moveTo(0.5).edit.empty());
}

// Heights of the table of movingScene, 1 m a second.
class PlaybackTest : public testing::Test {
 protected:
  Playback playback(bool repeats) const {
    return {ScriptPlayer(playedAnimation({0, 2, 25}, 1, *scene), scene, {}), repeats};
  }
  static std::optional<double> height(Playback& playback, int ms) {
    const ScriptPlayer::Step step = playback.pass(milliseconds(ms));
    if (step.edit.objects.empty()) return std::nullopt;
    return step.edit.objects[0].motion[3].y;
  }
  const std::shared_ptr<const Scene> scene = std::make_shared<const Scene>(movingScene());
};

TEST_F(PlaybackTest, StaysAtItsEndAndMayBeginAgain) {
  Playback once = playback(false);
  EXPECT_NEAR(height(once, 500).value(), 0.5, 1e-12);
  EXPECT_NEAR(height(once, 5000).value(), 2, 1e-12);
  EXPECT_FALSE(once.isPlaying());
  EXPECT_FALSE(height(once, 500));
  once.toggle();
  EXPECT_NEAR(height(once, 250).value(), 0.25, 1e-12);
}

TEST_F(PlaybackTest, RepeatsAndPauses) {
  Playback again = playback(true);
  EXPECT_NEAR(height(again, 1500).value(), 1.5, 1e-12);
  EXPECT_NEAR(height(again, 1500).value(), 1, 1e-12);
  again.toggle();
  EXPECT_FALSE(height(again, 700));
  again.toggle();
  EXPECT_NEAR(height(again, 250).value(), 1.25, 1e-12);
}

TEST(Script, EveryStateIsAnEditThatTheSceneTakes) {
  const Scene scene = someScene();
  const Script script = parseScript(R"({"seconds": 3, "events": [
      {"from": 0, "to": 3, "object": "ball", "by": [9, 1, 2], "turn": 720},
      {"from": 1, "to": 2, "material": "glass", "transmission": 1, "emission": [5, 5, 5]}]})",
                                    "s.json", scene);
  for (double t = 0; t <= 3; t += 0.01) {
    EXPECT_NO_THROW(checkEdit(scene, script.at(t, scene, {}).edit));
    EXPECT_EQ(script.at(t, scene, {}), script.at(t, scene, {}));
  }
}

TEST(Script, SaysWhatIsWrongAndWhere) {
  const auto has = [](const std::string& text, const char* part) {
    EXPECT_NE(errorOf(text).find(part), std::string::npos) << errorOf(text);
  };
  has("{", "s.json: not JSON");
  has(R"([1])", "s.json: must be an object");
  has(R"({"events": []})", "\"seconds\" is missing");
  has(R"({"seconds": -1, "events": []})", "\"seconds\" is -1");
  has(R"({"seconds": 1, "events": [], "rat": 3})", "\"rat\" is unknown");
  has(R"({"seconds": 1, "events": [], "rate": 3, "shots": 3})", "exclude each other");
  has(R"({"seconds": 1, "events": [], "shots": 0})", "\"shots\" is 0");
  has(R"({"seconds": 1, "events": [{"at": 0}]})", "event 0: needs");
  has(R"({"seconds": 1, "events": [{"from": 1, "to": 0, "camera": ["front"]}]})", "\"to\" is 0");
  has(R"({"seconds": 1, "events": [{"at": 0, "camera": ["back"]}]})", "event 0: no camera 'back'");
  has(R"({"seconds": 1, "events": [{"at": 0, "object": "cup"}]})", "no object 'cup'");
  has(R"({"seconds": 1, "events": [{"at": 0, "light": "sun"}]})", "no light 'sun'");
  has(R"({"seconds": 1, "events": [{"at": 0, "material": "glass", "ior": 0}]})", "\"ior\" is 0");
  has(R"({"seconds": 1, "events": [{"at": 0, "object": "ball", "by": [1, 2]}]})", "[x, y, z]");
  has(R"({"seconds": 1, "events": [{"at": 0, "animation": [0, -1]}]})", "[from, to]");
  has(R"({"seconds": 1, "events": [{"at": 0, "animation": [0, 1]}]})", "nothing is animated");
}

}  // namespace
}  // namespace ninefold
