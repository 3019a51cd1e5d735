// Numbers of a file that are a little out of order or range make sense all the same: they become
// the nearest ones that do, with a warning if that is more than a rounding.
#include <gtest/gtest.h>

#include "common/scene/emitters.h"
#include "common/scene/reader.h"
#include "tests/scene/gltf_bytes.h"
#include "tests/scene/one_line_error.h"
#include "tests/scene/temp_folder.h"

namespace ninefold {
namespace {

struct Read {
  Scene scene;
  std::string log;
};

Read readJson(const std::string& json) {
  const TempFolder folder;
  testing::internal::CaptureStderr();
  Scene scene = readScene(folder.write("scene.glb", triangleGlb(json)));
  return {std::move(scene), testing::internal::GetCapturedStderr()};
}

Read readSpot(const std::string& spot) {
  std::string json = with(kTriangleJson, R"("mesh": 0})",
                          R"("mesh": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}})");
  return readJson(with(
      json, R"("materials")",
      R"("extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "intensity": 100)" +
          spot + R"(}]}}, "materials")"));
}

TEST(GltfCone, AnglesOutOfOrderOrRangeAreTheNearestThatMakeSense) {
  constexpr float kHalf = 1.5707964f, kQuarter = 0.7853982f;
  struct Case {
    const char* spot;
    float inner, outer;
    bool warns;
  };
  for (const Case& c :
       {Case{R"(, "spot": {"innerConeAngle": 0.5, "outerConeAngle": 0.5})", 0.5f, 0.5f, false},
        Case{R"(, "spot": {"innerConeAngle": 0.4999, "outerConeAngle": 0.5})", 0.4999f, 0.5f,
             false},
        Case{R"(, "spot": {"innerConeAngle": 0.1})", 0.1f, kQuarter, false},
        Case{R"(, "spot": {"innerConeAngle": 0.9})", kQuarter, kQuarter, true},
        Case{R"(, "spot": {"outerConeAngle": 1.5708})", 0, kHalf, false},
        Case{R"(, "spot": {"outerConeAngle": 1.6})", 0, kHalf, true},
        Case{R"(, "spot": {"innerConeAngle": -0.2, "outerConeAngle": 0.5})", 0, 0.5f, true},
        Case{R"(, "spot": {"innerConeAngle": 0, "outerConeAngle": 0})", 0, 0, false}}) {
    const Read read = readSpot(c.spot);
    ASSERT_EQ(read.scene.lights.size(), 1u) << c.spot;
    EXPECT_NEAR(read.scene.lights[0].innerCone, c.inner, 1e-4f) << c.spot;
    EXPECT_NEAR(read.scene.lights[0].outerCone, c.outer, 1e-4f) << c.spot;
    EXPECT_EQ(read.log.find("cone angles") != std::string::npos, c.warns) << c.spot << read.log;
  }
}

// A hard-edged lamp: all of I inside, nothing outside of the cone.
TEST(GltfCone, EqualAnglesHaveASharpEdge) {
  PunctualLight light =
      readSpot(R"(, "spot": {"innerConeAngle": 0.5, "outerConeAngle": 0.5})").scene.lights[0];
  light.direction = Vec3(0, 0, 1);
  const auto at = [&](float angle) {
    return Emitters::intensity(Scene{}, light, Vec3(std::sin(angle), 0, std::cos(angle))).x;
  };
  EXPECT_EQ(at(0), 100);
  EXPECT_EQ(at(0.497f), 100);
  EXPECT_EQ(at(0.5005f), 0);
}

TEST(GltfCone, FactorsBeyondTheirRangeAreClamped) {
  const Read rounding =
      readJson(with(kTriangleJson, R"({"name": "paint"})",
                    R"({"name": "paint", "pbrMetallicRoughness": {"metallicFactor": 1.0000001,
             "baseColorFactor": [1.0000002, 0.5, -1e-9, 1.0000001]}})"));
  EXPECT_EQ(rounding.scene.materials[0].baseColor, Vec3(1, 0.5f, 0));
  EXPECT_EQ(rounding.scene.materials[0].opacity, 1);
  EXPECT_EQ(rounding.log.find("is read as"), std::string::npos);
  const Read far =
      readJson(with(kTriangleJson, R"({"name": "paint"})",
                    R"({"name": "paint", "emissiveFactor": [-1, 0, 0], "pbrMetallicRoughness": {
             "baseColorFactor": [2, 0, 0, 1], "roughnessFactor": 3}})"));
  EXPECT_EQ(far.scene.materials[0].baseColor, Vec3(1, 0, 0));
  EXPECT_EQ(far.scene.materials[0].roughness, 1);
  EXPECT_EQ(far.scene.materials[0].emission, Vec3(0));
  EXPECT_CONTAINS(far.log, "material 0 'paint': its base colour is 2 and read as 1");
  EXPECT_CONTAINS(far.log, "its emission is -1 and read as 0");
}

}  // namespace
}  // namespace ninefold
