// Light from outside that a glTF file brings: which face of the cube is seen in which direction.
#include "common/scene/gltf_image_light.h"

#include <gtest/gtest.h>

#include "common/scene/reader.h"
#include "tests/scene/gltf_bytes.h"
#include "tests/scene/one_line_error.h"
#include "tests/scene/png_bytes.h"
#include "tests/scene/temp_folder.h"

namespace ninefold {
namespace {

using Texels = std::vector<unsigned char>;

// Faces of 4 x 4 texels, each of one colour but for what a test paints.
class ImageLightTest : public testing::Test {
 protected:
  ImageLightTest() {
    for (size_t face = 0; face < 6; ++face) {
      const Texels colour = {static_cast<unsigned char>(40 * (face + 1)), 255, 0, 255};
      for (int i = 0; i < 16; ++i)
        faces_[face].insert(faces_[face].end(), colour.begin(), colour.end());
    }
  }

  // White at column x, row y of a face.
  void paint(size_t face, int x, int y) {
    for (int c = 0; c < 4; ++c) faces_[face][static_cast<size_t>(4 * (4 * y + x) + c)] = 255;
  }

  Scene read(const std::string& members = "", const ReadOptions& options = {}) {
    std::string images, list;
    for (size_t face = 0; face < 6; ++face) {
      const std::string name = "f" + std::to_string(face) + ".png";
      const Texels file = png(4, 4, 4, faces_[face]);
      folder_.write(name, file);
      images += (face > 0 ? ", " : "") + ("{\"uri\": \"" + name + "\"}");
      list += (face > 0 ? ", " : "") + std::to_string(face);
    }
    const std::string light =
        R"({"specularImageSize": 4, "specularImages": [[)" + list + "]]" + members + "}";
    std::string json =
        with(kTriangleJson, R"("materials")",
             R"("extensionsUsed": ["EXT_lights_image_based"], "images": [)" + images +
                 R"(], "extensions": {"EXT_lights_image_based": {"lights": [)" + light +
                 R"(]}}, "materials")");
    json = with(json, R"("nodes": [0])",
                R"("nodes": [0], "extensions": {"EXT_lights_image_based": {"light": 0}})");
    return readScene(folder_.write("scene.glb", triangleGlb(json)), options);
  }

  TempFolder folder_;
  Texels faces_[6];
};

float decoded(int byte) {
  const float v = static_cast<float>(byte) / 255;
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

TEST_F(ImageLightTest, FacesAreInTheOrderOfTheirAxes) {
  const Scene scene = read();
  ASSERT_TRUE(scene.environmentMap);
  EXPECT_EQ(scene.environment, Radiance(1));
  const Vec3 axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int face = 0; face < 6; ++face)
    EXPECT_NEAR(scene.environmentMap->towards(axes[face]).x, decoded(40 * (face + 1)), 1e-3f)
        << face;
  EXPECT_NEAR(scene.environmentMap->towards(Vec3(1, 0, 0)).y, 1, 1e-3f);
}

// A face whose upper left quarter is white, as seen from the middle; all else is black.
TEST_F(ImageLightTest, FacesAreSeenFromInside) {
  const Vec3 axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  const Vec3 corners[] = {{1, 1, -1}, {-1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, -1}};
  for (size_t face = 0; face < 6; ++face) {
    for (auto& other : faces_)
      for (size_t i = 0; i < other.size(); ++i) other[i] = i % 4 == 3 ? 255 : 0;
    for (const int y : {0, 1})
      for (const int x : {0, 1}) paint(face, x, y);
    const Scene scene = read();
    const Vec3 aside = 0.5f * (corners[face] - axes[face]), turned = glm::cross(axes[face], aside);
    const auto seen = [&](Vec3 from) {
      return scene.environmentMap->towards(glm::normalize(axes[face] + from)).x;
    };
    EXPECT_GT(seen(aside), 0.7f) << face;
    for (const Vec3 other : {-aside, turned, -turned}) EXPECT_LT(seen(other), 0.2f) << face;
  }
}

TEST_F(ImageLightTest, AlphaOfAPngDividesTheColour) {
  for (size_t i = 3; i < faces_[0].size(); i += 4) faces_[0][i] = 51;
  EXPECT_NEAR(read().environmentMap->towards(Vec3(1, 0, 0)).y, 5, 1e-2f);
}

// A quarter turn about +y brings what was at +x to -z.
TEST_F(ImageLightTest, IntensityAndRotationCount) {
  const Scene scene = read(R"(, "intensity": 3, "rotation": [0, 0.70710678, 0, 0.70710678])");
  EXPECT_EQ(scene.environment, Radiance(3));
  EXPECT_NEAR(scene.environmentMap->towards(Vec3(0, 0, -1)).x, decoded(40), 1e-3f);
}

TEST_F(ImageLightTest, WhatAPersonAsksForComesFirst) {
  EXPECT_FALSE(read("", {.hasColorOutside = true}).environmentMap);
}

// And the scene has the white outside of one without light.
TEST_F(ImageLightTest, WhatCannotBeReadIsOneWarning) {
  for (const char* bad :
       {R"(, "rotation": [0, 0, 0, 0])", R"(, "intensity": -1)", R"(, "intensity": 1e300)",
        R"(, "specularImages": [])", R"(, "specularImages": [[0, 1, 2]])",
        R"(, "specularImages": 7)", R"(, "specularImages": [[0, 1, 2, 3, 4, 9]])"}) {
    testing::internal::CaptureStderr();
    const Scene scene = read(bad);
    EXPECT_CONTAINS(testing::internal::GetCapturedStderr(), "EXT_lights_image_based 0: ") << bad;
    EXPECT_FALSE(scene.environmentMap) << bad;
    EXPECT_EQ(scene.environment, Radiance(1)) << bad;
  }
}

TEST_F(ImageLightTest, FacesMustBeSquareAndOfOneSize) {
  const Texels wide(32, 255);
  for (const Texels& file : {png(4, 2, 4, wide), png(2, 2, 4, Texels(16, 255)), Texels{1, 2, 3}}) {
    read();
    folder_.write("f3.png", file);
    testing::internal::CaptureStderr();
    const Scene scene = readScene(folder_.path() / "scene.glb");
    EXPECT_CONTAINS(testing::internal::GetCapturedStderr(), "its light from outside is missing");
    EXPECT_FALSE(scene.environmentMap);
  }
}

TEST(EnvironmentOutside, AColourThatIsAskedForNeedsNoWarning) {
  const TempFolder folder;
  const auto file = folder.write("scene.glb", triangleGlb());
  testing::internal::CaptureStderr();
  const Scene scene = readScene(file, {.hasColorOutside = true});
  EXPECT_EQ(testing::internal::GetCapturedStderr().find("no light in the file"), std::string::npos);
  EXPECT_EQ(scene.environment, Radiance(0));
}

}  // namespace
}  // namespace ninefold
