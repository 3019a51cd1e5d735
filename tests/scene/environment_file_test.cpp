// Pictures of all directions from files, good and bad, and what --environment and --sky may say.
#include "common/scene/environment_file.h"

#include <gtest/gtest.h>

#include <limits>

#include "common/base/command_line.h"
#include "common/image/image_file.h"
#include "common/scene/reader.h"
#include "tests/scene/gltf_bytes.h"
#include "tests/scene/one_line_error.h"
#include "tests/scene/temp_folder.h"

namespace ninefold {
namespace {

class EnvironmentFiles : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  static RgbImage image(int width, int height) {
    RgbImage made;
    made.reset(width, height);
    for (size_t i = 0; i < made.count(); ++i) {
      const auto x = static_cast<float>(i);
      made.pixels.r[i] = x, made.pixels.g[i] = 1, made.pixels.b[i] = 0.5f;
    }
    return made;
  }
  std::string written(const std::string& name, const RgbImage& picture) const {
    writeImage(path(name), {picture, {}, {}});
    return path(name);
  }
  static std::string complaint(const std::string& file) {
    const std::string line = errorOf([&] { readEnvironment(EnvironmentFile{file}); });
    EXPECT_CONTAINS(line, file);
    return line;
  }
  const TempFolder folder_;
};

TEST_F(EnvironmentFiles, AreReadTexelByTexel) {
  for (const char* name : {"a.exr", "a.hdr"}) {
    const auto map = readEnvironment(EnvironmentFile{written(name, image(8, 4)), 90, 2});
    const EnvironmentPicture& picture = map->picture();
    ASSERT_EQ(picture.width, 8);
    ASSERT_EQ(picture.height, 4);
    for (size_t i = 0; i < 32; ++i)
      EXPECT_NEAR(picture.texels[i].x, static_cast<float>(i), 0.01f * static_cast<float>(i) + 0.1f);
    EXPECT_NEAR(picture.rotation, 0.5f * kPi, 1e-6f);
  }
  EXPECT_EQ(readEnvironment({}), nullptr);
}

TEST_F(EnvironmentFiles, BadOnesAreRefusedInOneLine) {
  EXPECT_CONTAINS(complaint(path("none.exr")), "cannot read");
  EXPECT_CONTAINS(complaint(written("one.exr", image(1, 1))), "twice as wide");
  EXPECT_CONTAINS(complaint(written("square.exr", image(8, 8))), "twice as wide");
  RgbImage bad = image(8, 4);
  bad.pixels.g[11] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_CONTAINS(complaint(written("nan.exr", bad)), "pixel (3, 1) is nan");
  bad.pixels.g[11] = std::numeric_limits<float>::infinity();
  EXPECT_CONTAINS(complaint(written("inf.exr", bad)), "pixel (3, 1) is inf");
  folder_.write("huge.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8192 +X 16384\n");
  EXPECT_CONTAINS(complaint(path("huge.hdr")), "more than 8192 on a side");
  folder_.write("text.hdr", "no picture");
  EXPECT_CONTAINS(complaint(path("text.hdr")), "cannot read");
}

TEST_F(EnvironmentFiles, TruncatedOnesAreRefused) {
  RgbImage noise = image(64, 32);
  for (const char* name : {"whole.exr", "whole.hdr"}) {
    const std::string whole = written(name, noise);
    std::ifstream file(whole, std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(file), {});
    for (const size_t kept : {bytes.size() / 4, bytes.size() / 2, bytes.size() - 40}) {
      const std::string cut = "cut" + std::string(name).substr(5);
      folder_.write(cut, std::string_view(bytes).substr(0, kept));
      complaint(path(cut));
    }
  }
}

TEST_F(EnvironmentFiles, NegativeValuesAreTakenAsNothing) {
  RgbImage dark = image(8, 4);
  dark.pixels.b[3] = -0.25f;
  const std::string file = written("dark.exr", dark);
  testing::internal::CaptureStderr();
  const auto map = readEnvironment(EnvironmentFile{file});
  EXPECT_CONTAINS(testing::internal::GetCapturedStderr(), "1 values of the environment");
  EXPECT_EQ(map->picture().texels[3].z, 0);
}

// Wide pictures keep their mean.
TEST_F(EnvironmentFiles, WideOnesAreHalved) {
  RgbImage wide;
  wide.reset(4100, 2050);
  for (size_t i = 0; i < wide.count(); ++i) wide.pixels.r[i] = static_cast<float>(i % 4);
  const auto map = readEnvironment(EnvironmentFile{written("wide.exr", wide)});
  EXPECT_EQ(map->picture().width, 2050);
  EXPECT_EQ(map->picture().texels[0].x, 0.5f) << "of 0 and 1, twice";
  EXPECT_EQ(map->picture().texels[1].x, 2.5f);
  wide.reset(4098, 2049);
  EXPECT_CONTAINS(complaint(written("odd.exr", wide)), "scale it to 4096 x 2048");
}

// A scene without a lamp is lit by it and needs no white outside.
TEST_F(EnvironmentFiles, LightAScene) {
  const auto file = folder_.write("scene.glb", triangleGlb());
  const std::string picture = written("a.exr", image(8, 4));
  testing::internal::CaptureStderr();
  const Scene scene = readScene(file, {.environment = EnvironmentFile{picture, 0, 2.5}});
  EXPECT_EQ(testing::internal::GetCapturedStderr().find("no light in the file"), std::string::npos);
  ASSERT_TRUE(scene.environmentMap);
  EXPECT_EQ(scene.environment, Radiance(2.5f));
}

TEST(EnvironmentFlag, NamesAFileARotationAndAStrength) {
  for (const char* plain : {"none", "1", "1,2,3", "hdr", "a.png"})
    EXPECT_FALSE(namesPicture(plain));
  const auto expectFile = [](const std::string& value, const char* path, double rotation,
                             double strength) {
    ASSERT_TRUE(namesPicture(value)) << value;
    const EnvironmentFile file = parseEnvironmentFile(value);
    EXPECT_EQ(file.path, path);
    EXPECT_EQ(file.rotation, rotation);
    EXPECT_EQ(file.strength, strength);
  };
  expectFile("a.hdr", "a.hdr", 0, 1);
  expectFile("a.EXR:-90", "a.EXR", -90, 1);
  expectFile("sky:x.hdr/b.exr:30:0.5", "sky:x.hdr/b.exr", 30, 0.5);
  for (const char* bad :
       {"a.hdr:x", "a.hdr:1:2:3", "a.hdr:", "a.hdr:400", "a.hdr:0:-1", "a.hdr:nan"})
    EXPECT_THROW(parseEnvironmentFile(bad), UsageError) << bad;
}

TEST(EnvironmentFlag, SaysASky) {
  const SkyModel sky = parseSky("120:30:4.5");
  EXPECT_EQ(sky.azimuth, 120);
  EXPECT_EQ(sky.elevation, 30);
  EXPECT_EQ(sky.turbidity, 4.5);
  EXPECT_EQ(parseSky("0:0").turbidity, 3);
  for (const char* bad : {"", "120", "120:91", "120:-1", "0:0:1", "0:0:11", "1:2:3:4", "a:b"})
    EXPECT_THROW(parseSky(bad), UsageError) << bad;
}

}  // namespace
}  // namespace ninefold
