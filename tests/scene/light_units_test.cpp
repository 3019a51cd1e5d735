// What a file's candela and lux are taken for. Expected values come from the exporter's own
// formula: a lamp of P watts is written as P * 683/(4 pi) cd, P/(4 pi) ("unitless") or P ("raw").
#include "common/scene/light_units.h"

#include <gtest/gtest.h>

#include "common/scene/reader.h"
#include "tests/scene/gltf_bytes.h"
#include "tests/scene/ies_text.h"
#include "tests/scene/one_line_error.h"
#include "tests/scene/temp_folder.h"

namespace ninefold {
namespace {

constexpr double kFourPi = 12.566370614359172;
constexpr const char* kBlender = "Khronos glTF Blender I/O v3.4.50";

TEST(LightUnits, AreToldByWhoWroteTheFileAndItsBrightestLamp) {
  struct Case {
    const char* generator;
    double brightest;
    bool isPhotometric, isDoubtful;
  };
  for (const Case& c :
       {Case{kBlender, 1000 * 683 / kFourPi, true, false},
        Case{kBlender, 683, true, false},              // a sun of 1 W/m^2
        Case{kBlender, 1000 / kFourPi, false, false},  // unitless
        Case{"Khronos glTF Blender I/O v4.2.57", 1e5, true, false},
        Case{"Khronos glTF Blender I/O v10.0.1", 1e5, true, false},
        Case{"Khronos glTF Blender I/O v3.3.27", 1000, false, true},
        Case{"Khronos glTF Blender I/O v1.2.75", 1000, false, true},
        Case{"Khronos glTF Blender I/O", 1000, false, true},
        Case{"Khronos glTF Blender I/O v", 1000, false, true},
        Case{"Khronos glTF Blender I/O v99999999999999999999", 1000, false, true},
        Case{"THREE.GLTFExporter r160", 1e5, false, false}, Case{"", 1e5, false, false}}) {
    const LightReading reading = readingOf(LightUnits::automatic, c.generator, c.brightest);
    EXPECT_EQ(reading.isPhotometric, c.isPhotometric) << c.generator << " " << c.brightest;
    EXPECT_EQ(reading.isDoubtful, c.isDoubtful) << c.generator;
    for (const LightUnits asked : {LightUnits::radiometric, LightUnits::photometric}) {
      const LightReading own = readingOf(asked, c.generator, c.brightest);
      EXPECT_EQ(own.isPhotometric, asked == LightUnits::photometric);
      EXPECT_CONTAINS(own.line, "as asked");
    }
  }
}

TEST(LightUnits, TheLineSaysHowToHaveTheOther) {
  EXPECT_CONTAINS(readingOf(LightUnits::automatic, kBlender, 1e4).line,
                  "--light-units radiometric");
  EXPECT_CONTAINS(readingOf(LightUnits::automatic, "", 1).line, "--light-units photometric");
  const std::string line =
      readingOf(LightUnits::automatic, "evil\nname" + std::string(500, 'x'), 1).line;
  EXPECT_EQ(line.find('\n'), std::string::npos);
  EXPECT_LT(line.size(), 250u);
}

// Blender's first scene, whose lamp of 1,000 W is written as 54,351 cd.
TEST(LightUnits, BlendersLampIsItsWattsOverTheSphere) {
  const std::string file = NINEFOLD_SCENES "/../tests/scene/blender_default.glb";
  testing::internal::CaptureStderr();
  const Scene scene = readScene(file);
  const std::string log = testing::internal::GetCapturedStderr();
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_NEAR(double{scene.lights[0].intensity.x}, 1000 / kFourPi, 1e-4);
  EXPECT_CONTAINS(log, "photometric (written by Khronos glTF Blender I/O v3.4.50)");
  const Scene plain = readScene(file, {.lightUnits = LightUnits::radiometric});
  EXPECT_NEAR(double{plain.lights[0].intensity.x}, 1000 * 683 / kFourPi, 0.1);
}

// Suns by lux, and measured lamps by their candela, go by the same rule.
TEST(LightUnits, HoldForAllLampsOfAFile) {
  const TempFolder folder;
  std::string json =
      with(kTriangleJson, R"("nodes": [{"name": "thing", "mesh": 0}])",
           R"("nodes": [{"mesh": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}},
                   {"extensions": {"EXT_lights_ies": {"light": 0}}}],
         "extensions": {"KHR_lights_punctual": {"lights": [{"type": "directional",
         "intensity": 683}]}, "EXT_lights_ies": {"lights": [{"uri": "a.ies"}]}})");
  json = with(json, R"("nodes": [0])", R"("nodes": [0, 1])");
  folder.write("a.ies", IesText{}.text());
  const auto file = folder.write("scene.glb", triangleGlb(json));
  const Scene plain = readScene(file);
  const Scene divided = readScene(file, {.lightUnits = LightUnits::photometric});
  ASSERT_EQ(divided.lights.size(), 2u);
  EXPECT_EQ(plain.lights[0].intensity, Vec3(683));
  EXPECT_EQ(divided.lights[0].intensity, Vec3(1));
  EXPECT_FLOAT_EQ(683 * divided.lights[1].intensity.x, plain.lights[1].intensity.x);
  EXPECT_GT(divided.lights[1].intensity.x, 0);
}

TEST(LightUnits, AFileWithoutLampsSaysNothing) {
  const TempFolder folder;
  testing::internal::CaptureStderr();
  readScene(folder.write("scene.glb", triangleGlb()));
  EXPECT_EQ(testing::internal::GetCapturedStderr().find("lamps:"), std::string::npos);
}

}  // namespace
}  // namespace ninefold
