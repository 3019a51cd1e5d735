// Animations: read from glTF, and where they put things. Expected places are worked out by hand.
#include "common/scene/animation.h"

#include <gtest/gtest.h>

#include <numbers>
#include <tuple>

#include "common/scene/reader.h"
#include "common/scene/world.h"
#include "tests/scene/gltf_bytes.h"
#include "tests/scene/one_line_error.h"
#include "tests/scene/temp_folder.h"

namespace ninefold {
namespace {

// The triangle (0,0,0) (2,0,0) (0,2,0), its nodes, and tracks that move them.
class AnimatedFile {
 public:
  // `more`: what the file has beside; `roots`: the nodes of the scene.
  explicit AnimatedFile(std::string nodes = R"({"name": "thing", "mesh": 0})",
                        std::string roots = "[0]", std::string more = "")
      : nodes_(std::move(nodes)),
        roots_(std::move(roots)),
        more_(std::move(more)),
        bytes_(triangleBytes()) {}

  AnimatedFile& move(int node, const std::string& path, const std::string& kind,
                     const std::vector<float>& times, const std::vector<float>& values,
                     int components) {
    const int input = accessor(times, 1), output = accessor(values, components);
    const std::string comma = samplers_.empty() ? "" : ", ";
    channels_ += comma + R"({"sampler": )" + std::to_string(count_++) + R"(, "target": {"node": )" +
                 std::to_string(node) + R"(, "path": ")" + path + "\"}}";
    samplers_ += comma + R"({"input": )" + std::to_string(input) + R"(, "output": )" +
                 std::to_string(output) + R"(, "interpolation": ")" + kind + "\"}";
    return *this;
  }
  Scene read() const {
    std::string json = with(kTriangleJson, R"({"name": "thing", "mesh": 0})", nodes_);
    json = with(json, R"("nodes": [0])", R"("nodes": )" + roots_);
    json = with(json, R"("type": "SCALAR"})", R"("type": "SCALAR"})" + accessors_);
    json = with(json, R"("byteLength": 12})", R"("byteLength": 12})" + views_);
    json = with(json, R"("byteLength": 48}])",
                R"("byteLength": )" + std::to_string(bytes_.size()) + R"(}], "animations": [)" +
                    R"({"channels": [)" + channels_ + R"(], "samplers": [)" + samplers_ + "]}]" +
                    more_);
    const TempFolder folder;
    return readScene(folder.write("scene.glb", glb(json, bytes_)));
  }

 private:
  int accessor(const std::vector<float>& values, int components) {
    views_ += R"(, {"buffer": 0, "byteOffset": )" + std::to_string(bytes_.size()) +
              R"(, "byteLength": )" + std::to_string(4 * values.size()) + "}";
    append(bytes_, values);
    constexpr const char* kTypes[] = {"", "SCALAR", "", "VEC3", "VEC4"};
    accessors_ += R"(, {"bufferView": )" + std::to_string(used_) +
                  R"(, "componentType": 5126, "count": )" +
                  std::to_string(values.size() / static_cast<size_t>(components)) +
                  R"(, "type": ")" + kTypes[components] + "\"}";
    return used_++;
  }

  std::string nodes_, roots_, more_, accessors_, views_, channels_, samplers_;
  Bytes bytes_;
  int count_ = 0, used_ = 2;
};

// Where a point of the first instance's mesh is at a time, in file coordinates.
DVec3 placeAt(const Scene& scene, double time, DVec3 p = DVec3(0)) {
  const Scene now = edited(scene, animationAt(scene, time));
  return DVec3(now.instances[0].toWorld * DVec4(p, 1)) + scene.origin;
}

void expectNear(DVec3 a, DVec3 b) {
  EXPECT_NEAR(glm::length(a - b), 0, 1e-6) << a.x << " " << a.y << " " << a.z;
}

TEST(Animation, LinearTracksGoEvenlyAndStayAtTheirEnds) {
  const Scene scene =
      AnimatedFile()
          .move(0, "translation", "LINEAR", {1, 2, 4}, {0, 0, 0, 4, 0, 0, 4, 2, 0}, 3)
          .read();
  expectNear(placeAt(scene, 0), DVec3(0));
  expectNear(placeAt(scene, 1.25), DVec3(1, 0, 0));
  expectNear(placeAt(scene, 3), DVec3(4, 1, 0));
  expectNear(placeAt(scene, 9), DVec3(4, 2, 0));
  EXPECT_EQ(animationEnd(scene), 4);
}

TEST(Animation, StepsJumpWhenTheKeyIsReached) {
  const Scene scene =
      AnimatedFile().move(0, "translation", "STEP", {0, 2}, {1, 0, 0, 0, 5, 0}, 3).read();
  expectNear(placeAt(scene, 1.999), DVec3(1, 0, 0));
  expectNear(placeAt(scene, 2), DVec3(0, 5, 0));
}

TEST(Animation, RotationsGoTheShorterWay) {
  // A quarter turn about z, its quaternion with the other sign: still a quarter, not three.
  const float s = std::numbers::sqrt2_v<float> / 2;
  const Scene scene =
      AnimatedFile().move(0, "rotation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, 0, -s, -s}, 4).read();
  const double angle = std::numbers::pi / 6;
  expectNear(placeAt(scene, 1.0 / 3, DVec3(2, 0, 0)),
             DVec3(2 * std::cos(angle), 2 * std::sin(angle), 0));
  expectNear(placeAt(scene, 1, DVec3(2, 0, 0)), DVec3(0, 2, 0));
}

TEST(Animation, CubicTracksFollowTheirTangents) {
  // x: from 0 to 1 in two seconds, with tangents 3 and 0 [m/s]: at s = 1/2
  //    1/2 * 0 + 2 (1/8) 3 + 1/2 * 1 + 2 (-1/8) 0 = 1.25
  const std::vector<float> keys{0, 0, 0, 0, 0, 0, 3, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0};
  const Scene scene = AnimatedFile().move(0, "translation", "CUBICSPLINE", {0, 2}, keys, 3).read();
  expectNear(placeAt(scene, 1), DVec3(1.25, 0, 0));
  expectNear(placeAt(scene, 0), DVec3(0));
  expectNear(placeAt(scene, 2), DVec3(1, 0, 0));
  expectNear(placeAt(scene, 5), DVec3(1, 0, 0));
}

TEST(Animation, ChildrenGoWithWhatIsAboveThem) {
  const std::string nodes = R"({"children": [1], "translation": [0, 0, 10]},
      {"matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 1,0,0,1], "children": [2]},
      {"name": "thing", "mesh": 0, "scale": [2, 2, 2]})";
  const float s = std::numbers::sqrt2_v<float> / 2;
  const Scene scene = AnimatedFile(nodes)
                          .move(0, "rotation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, s, 0, s}, 4)
                          .move(2, "scale", "LINEAR", {0, 1}, {2, 2, 2, 4, 4, 4}, 3)
                          .read();
  EXPECT_EQ(scene.animated.size(), 3u);
  expectNear(placeAt(scene, 0, DVec3(1, 0, 0)), DVec3(3, 0, 10));
  expectNear(placeAt(scene, 1, DVec3(1, 0, 0)), DVec3(0, 0, 5));  // (4 + 1) along x, turned to -z
}

TEST(Animation, WhatIsNotAnimatedOfANodeStaysToTheLastDigit) {
  const std::string nodes = R"({"name": "thing", "mesh": 0, "translation": [100000.001, 0, 0]})";
  const Scene scene =
      AnimatedFile(nodes).move(0, "scale", "LINEAR", {0, 1}, {1, 1, 1, 3, 1, 1}, 3).read();
  EXPECT_EQ(animationAt(scene, 0).objects.at(0).motion, DMat4(1));
  EXPECT_NEAR(placeAt(scene, 1).x, 100000.001, 1e-9);
}

TEST(Animation, LightsAndCamerasMoveToo) {
  const float s = std::numbers::sqrt2_v<float> / 2;
  AnimatedFile file(
      R"({"mesh": 0}, {"extensions": {"KHR_lights_punctual": {"light": 0}}},
                       {"name": "eye", "camera": 0}, {"name": "other", "camera": 0})",
      "[0, 1, 2, 3]",
      R"(, "cameras": [{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.1}}],
      "extensionsUsed": ["KHR_lights_punctual"],
      "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "spot": {}}]}})");
  file.move(1, "translation", "LINEAR", {0, 1}, {0, 0, 0, 0, 3, 0}, 3);
  file.move(2, "rotation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, s, 0, s}, 4);
  const Scene scene = file.read();
  const SceneEdit now = animationAt(scene, 1);
  EXPECT_TRUE(now.objects.empty());
  ASSERT_EQ(now.lights.size(), 1u);
  expectNear(DVec3(now.lights[0].position) + scene.origin, DVec3(0, 3, 0));
  EXPECT_EQ(now.lights[0].intensity, scene.lights[0].intensity);
  const Camera turned = animatedCamera(scene, scene.cameras[0], 1);
  expectNear(DVec3(turned.forward), DVec3(-1, 0, 0));
  EXPECT_EQ(animatedCamera(scene, scene.cameras[0], 0), scene.cameras[0]);
  EXPECT_EQ(animatedCamera(scene, scene.cameras[1], 1), scene.cameras[1]);
}

TEST(Animation, EveryPlaceIsAnEditThatTheSceneTakes) {
  const Scene scene =
      AnimatedFile()
          .move(0, "scale", "LINEAR", {0, 1, 2}, {1, 1, 1, 0, 0, 0, -1, 1, 1}, 3)
          .move(0, "rotation", "CUBICSPLINE", {0, 2},
                {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, -1, 0, 0, 0, 0}, 4)
          .read();
  for (double t = 0; t <= 2; t += 0.125) EXPECT_NO_THROW(checkEdit(scene, animationAt(scene, t)));
}

TEST(Animation, SaysWhatIsWrongAndWhere) {
  const auto has = [](const AnimatedFile& file, const char* part) {
    const std::string text = errorOf([&] { file.read(); });
    EXPECT_CONTAINS(text, "animation 0 '', channel 0: ");
    EXPECT_CONTAINS(text, part);
  };
  const std::vector<float> two{0, 0, 0, 1, 0, 0};
  has(AnimatedFile().move(0, "translation", "LINEAR", {1, 1}, two, 3), "time 1 is 1 after 1");
  has(AnimatedFile().move(0, "translation", "LINEAR", {-1, 1}, two, 3), "time 0 is -1");
  has(AnimatedFile().move(0, "translation", "LINEAR", {0, NAN}, two, 3), "time 1 is nan");
  has(AnimatedFile().move(0, "translation", "LINEAR", {0}, two, 3), "1 times and 2 values");
  has(AnimatedFile().move(0, "translation", "CUBICSPLINE", {0, 1}, two, 3), "2 times and 2 values");
  has(AnimatedFile().move(0, "translation", "BOUNCE", {0, 1}, two, 3), "'BOUNCE' is unknown");
  has(AnimatedFile().move(0, "translation", "LINEAR", {0, 1}, {0, 0, 0, INFINITY, 0, 0}, 3),
      "value 1 is not finite");
  has(AnimatedFile().move(0, "rotation", "LINEAR", {0}, {0, 0, 0, 0}, 4), "no quaternion");
  has(AnimatedFile().move(0, "rotation", "LINEAR", {0, 1}, two, 3), "has 3 components, 4");
  has(AnimatedFile().move(7, "translation", "LINEAR", {0, 1}, two, 3), "node 7 does not exist");
  has(AnimatedFile(R"({"mesh": 0, "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]})")
          .move(0, "translation", "LINEAR", {0, 1}, two, 3),
      "node 0 has a matrix");
}

TEST(Animation, WhatCannotBePlayedIsLeftOut) {
  const Scene scene = AnimatedFile().move(0, "weights", "LINEAR", {0, 1}, {0, 1}, 1).read();
  EXPECT_TRUE(scene.animated.empty());
}

// Scaled to nothing as it is read, by its own node, by the one above, or along an axis: when the
// animation says so it is there, in its whole size.
TEST(Animation, LiftsWhatIsReadWithoutSize) {
  const std::string parent =
      R"({"name": "thing", "mesh": 0}, {"children": [0], "scale": [0, 0, 0]})";
  for (const auto& [nodes, roots, node] :
       {std::tuple(std::string(
                       R"({"mesh": 0, "scale": [0, 0, 0]}, {"mesh": 0, "translation": [9, 0, 0]})"),
                   "[0, 1]", 0),
        std::tuple(std::string(
                       R"({"mesh": 0, "scale": [1, 0, 1]}, {"mesh": 0, "translation": [9, 0, 0]})"),
                   "[0, 1]", 0),
        std::tuple(parent + R"(, {"mesh": 0, "translation": [9, 0, 0]})", "[1, 2]", 1)})
    for (const char* kind : {"STEP", "LINEAR"}) {
      const Scene scene = AnimatedFile(nodes, roots)
                              .move(node, "scale", kind, {0, 1}, {0, 0, 0, 1, 1, 1}, 3)
                              .read();
      ASSERT_EQ(scene.instances.size(), 2u) << nodes;
      expectNear(placeAt(scene, 1, DVec3(2, 2, 0)), DVec3(2, 2, 0));
      EXPECT_LT(glm::length(placeAt(scene, 0, DVec3(2, 2, 0))), 1e-4) << nodes;
    }
}

// A small scale that is not animated stays what it is.
TEST(Animation, LeavesSmallThingsSmall) {
  const Scene scene =
      AnimatedFile(R"({"mesh": 0, "scale": [1e-6, 1e-6, 1e-6]}, {"mesh": 0})", "[0, 1]")
          .move(0, "translation", "STEP", {0, 1}, {0, 0, 0, 1, 0, 0}, 3)
          .read();
  expectNear(placeAt(scene, 1, DVec3(2, 0, 0)), DVec3(1 + 2e-6, 0, 0));
}

// Nothing lifts these: a point and a line are left out, a sheet is shown.
TEST(Animation, WithoutOneWhatHasNoAreaIsLeftOut) {
  const auto count = [](const std::string& scale) {
    const TempFolder folder;
    const std::string json = with(kTriangleJson, R"({"name": "thing", "mesh": 0})",
                                  R"({"mesh": 0}, {"mesh": 0, "scale": )" + scale + "}");
    return readScene(folder.write("scene.glb",
                                  triangleGlb(with(json, "\"nodes\": [0]", "\"nodes\": [0, 1]"))))
        .instances.size();
  };
  EXPECT_EQ(count("[0, 0, 0]"), 1u);
  EXPECT_EQ(count("[0, 0, 1]"), 1u);
  EXPECT_EQ(count("[1, 1, 0]"), 2u);  // the triangle lies in z = 0
}

// Two animations; only the one that is chosen moves anything.
std::string twoClips(const std::string& first, const std::string& second) {
  std::string json = with(
      kTriangleJson, R"("type": "SCALAR"})",
      R"("type": "SCALAR"}, {"bufferView": 2, "componentType": 5126, "count": 2, "type": "SCALAR"},
                 {"bufferView": 3, "componentType": 5126, "count": 2, "type": "VEC3"})");
  json = with(json, R"("byteLength": 12})",
              R"("byteLength": 12}, {"buffer": 0, "byteOffset": 48, "byteLength": 8},
                 {"buffer": 0, "byteOffset": 56, "byteLength": 24})");
  const auto clip = [](const std::string& name, const char* path) {
    return "{" + name + R"("samplers": [{"input": 2, "output": 3}], "channels": [{"sampler": 0,
              "target": {"node": 0, "path": ")" +
           path + "\"}}]}";
  };
  return with(json, R"([{"byteLength": 48}])",
              R"([{"byteLength": 80}], "animations": [)" + clip(first, "translation") + ", " +
                  clip(second, "scale") + "]");
}

Bytes twoClipBytes() {
  Bytes bytes = triangleBytes();
  append<float>(bytes, {0, 1, 1, 1, 1, 3, 3, 3});
  return bytes;
}

TEST(Animation, PlaysOneClipAlone) {
  const TempFolder folder;
  const auto file = folder.write(
      "scene.glb", glb(twoClips(R"("name": "walk", )", R"("name": "grow", )"), twoClipBytes()));
  testing::internal::CaptureStderr();
  const Scene first = readScene(file);
  EXPECT_CONTAINS(testing::internal::GetCapturedStderr(),
                  "walk plays; --clip NAME chooses among walk, grow");
  const Scene walk = readScene(file, {.clip = "walk"}), grow = readScene(file, {.clip = "grow"});
  for (const Scene* scene : {&first, &walk})
    expectNear(placeAt(*scene, 1, DVec3(2, 0, 0)), DVec3(5, 3, 3));
  expectNear(placeAt(grow, 1, DVec3(2, 0, 0)), DVec3(6, 0, 0));
  EXPECT_CONTAINS(errorOf([&] { readScene(file, {.clip = "run"}); }),
                  "it has no animation 'run'; there is: walk, grow");
}

TEST(Animation, ClipsWithoutANameAreToldByTheirNumber) {
  const TempFolder folder;
  const auto file = folder.write("scene.glb", glb(twoClips("", ""), twoClipBytes()));
  expectNear(placeAt(readScene(file, {.clip = "1"}), 1, DVec3(2, 0, 0)), DVec3(6, 0, 0));
  const auto still = folder.write("still.glb", triangleGlb());
  EXPECT_CONTAINS(errorOf([&] { readScene(still, {.clip = "walk"}); }),
                  "the file has no animation");
  const auto obj = folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_CONTAINS(errorOf([&] { readScene(obj, {.clip = "walk"}); }),
                  "an .obj file has no animation");
}

}  // namespace
}  // namespace ninefold
