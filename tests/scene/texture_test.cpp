#include <gtest/gtest.h>

#include <limits>

#include "common/scene/texture.h"
#include "common/scene/texture_peaks.h"

namespace ninefold {
namespace {

Scene sceneOf(int width, int height, int channels, std::vector<uint8_t> texels, bool srgb = false) {
  Scene scene;
  scene.images.push_back({"image", width, height, channels, srgb, std::move(texels)});
  return scene;
}

TextureUse use(bool nearest = false) {
  TextureUse u;
  u.image = 0, u.nearest = nearest;
  return u;
}

float red(const Scene& scene, const TextureUse& u, float x, float y) {
  return lookUp(scene, u, Vec2(x, y), Vec2(0)).x;
}

TEST(Texture, MissingChannelsSpreadGreyAndAreOpaque) {
  EXPECT_EQ(lookUp(sceneOf(1, 1, 1, {51}), use(), Vec2(0), Vec2(0)), Vec4(0.2f, 0.2f, 0.2f, 1));
  EXPECT_EQ(lookUp(sceneOf(1, 1, 2, {51, 0}), use(), Vec2(0), Vec2(0)), Vec4(0.2f, 0.2f, 0.2f, 0));
  EXPECT_EQ(lookUp(sceneOf(1, 1, 3, {51, 0, 255}), use(), Vec2(0), Vec2(0)), Vec4(0.2f, 0, 1, 1));
  EXPECT_EQ(lookUp(sceneOf(1, 1, 4, {51, 0, 255, 0}), use(), Vec2(0), Vec2(0)),
            Vec4(0.2f, 0, 1, 0));
}

TEST(Texture, SrgbIsDecodedBeforeInterpolationAndAlphaIsNot) {
  const Scene scene = sceneOf(2, 1, 4, {0, 0, 0, 0, 255, 255, 255, 255}, true);
  const Vec4 middle = lookUp(scene, use(), Vec2(0.5f, 0.5f), Vec2(0));
  EXPECT_NEAR(middle.x, 0.5f, 1e-6f);
  EXPECT_NEAR(middle.w, 0.5f, 1e-6f);
  // Code 188 is half of white by the sRGB curve: 0.502886.
  const Scene half = sceneOf(1, 1, 4, {188, 188, 188, 188}, true);
  EXPECT_NEAR(lookUp(half, use(), Vec2(0), Vec2(0)).x, 0.502886f, 1e-5f);
  EXPECT_NEAR(lookUp(half, use(), Vec2(0), Vec2(0)).w, 188 / 255.0f, 1e-6f);
}

TEST(Texture, TexelCentresAreExactAndRowsGoDown) {
  const Scene scene = sceneOf(2, 2, 1, {0, 51, 102, 153});
  EXPECT_FLOAT_EQ(red(scene, use(), 0.25f, 0.25f), 0);
  EXPECT_FLOAT_EQ(red(scene, use(), 0.75f, 0.25f), 0.2f);
  EXPECT_FLOAT_EQ(red(scene, use(), 0.25f, 0.75f), 0.4f);
  EXPECT_FLOAT_EQ(red(scene, use(true), 0.99f, 0.99f), 0.6f);
}

TEST(Texture, WrapModes) {
  const Scene scene = sceneOf(4, 1, 1, {0, 85, 170, 255});
  TextureUse u = use(true);
  u.wrapS = Wrap::repeat;
  EXPECT_FLOAT_EQ(red(scene, u, 1.3f, 0), red(scene, u, 0.3f, 0));
  EXPECT_FLOAT_EQ(red(scene, u, -0.1f, 0), 1);
  u.wrapS = Wrap::clamp;
  EXPECT_FLOAT_EQ(red(scene, u, 7, 0), 1);
  EXPECT_FLOAT_EQ(red(scene, u, -7, 0), 0);
  u.wrapS = Wrap::mirror;
  EXPECT_FLOAT_EQ(red(scene, u, 1.1f, 0), 1);
  EXPECT_FLOAT_EQ(red(scene, u, 1.9f, 0), 0);
  EXPECT_FLOAT_EQ(red(scene, u, -0.3f, 0), red(scene, u, 0.3f, 0));
}

TEST(Texture, InterpolatesAcrossTheSeamOnlyWhenItRepeats) {
  const Scene scene = sceneOf(2, 1, 1, {0, 255});
  TextureUse u = use();
  EXPECT_NEAR(red(scene, u, 0, 0.5f), 0.5f, 1e-6f);
  u.wrapS = Wrap::clamp;
  EXPECT_NEAR(red(scene, u, 0, 0.5f), 0, 1e-6f);
}

TEST(Texture, AbsurdCoordinatesStayInside) {
  const Scene scene = sceneOf(3, 3, 1, std::vector<uint8_t>(9, 255));
  for (const Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror})
    for (const float u :
         {1e30f, -1e30f, std::numeric_limits<float>::infinity(), std::nanf(""), -1e-30f})
      for (const bool nearest : {true, false}) {
        TextureUse t = use(nearest);
        t.wrapS = t.wrapT = wrap;
        EXPECT_FLOAT_EQ(red(scene, t, u, u), 1);
      }
}

TEST(Texture, TransformTakesTheQuadrantOfTheExtensionsExample) {
  // Offset (0,1), a quarter turn, scale one half: the lower left quadrant, turned.
  TextureUse u = use();
  u.offset = Vec2(0, 1), u.rotation = 0.5f * kPi, u.scale = Vec2(0.5f);
  for (const float x : {0.1f, 0.9f})
    for (const float y : {0.1f, 0.9f}) {
      const Vec2 uv = textureCoordinates(u, Vec2(x, y));
      EXPECT_GT(uv.x, 0);
      EXPECT_LT(uv.x, 0.5f);
      EXPECT_GT(uv.y, 0.5f);
      EXPECT_LT(uv.y, 1);
    }
}

TEST(Texture, SecondCoordinateSet) {
  const Scene scene = sceneOf(2, 1, 1, {0, 255});
  TextureUse u = use(true);
  u.uvSet = 1;
  EXPECT_EQ(lookUp(scene, u, Vec2(0), Vec2(0.9f, 0)).x, 1);
}

TEST(TexturePeaks, NeverBelowAnyLookupInsideTheBox) {
  std::vector<uint8_t> texels(100 * 70);
  uint32_t state = 1;
  for (uint8_t& t : texels) state = state * 1664525 + 1013904223, t = (state >> 24) > 250 ? 255 : 0;
  const Scene scene = sceneOf(100, 70, 1, texels);
  const TexturePeaks peaks(scene.images[0]);
  const auto random = [&] {
    return state = state * 1664525 + 1013904223, static_cast<float>(state >> 8) / (1 << 24);
  };
  int dark = 0;
  for (int i = 0; i < 2000; ++i) {
    TextureUse u = use();
    u.wrapS = static_cast<Wrap>(i % 3), u.wrapT = static_cast<Wrap>(i / 3 % 3);
    const Vec2 low(6 * random() - 3, 6 * random() - 3), size(0.03f * random(), 0.03f * random());
    const float peak = peaks.largest(u, low, low + size);
    dark += peak == 0;
    for (int k = 0; k < 10; ++k)
      EXPECT_LE(red(scene, u, low.x + size.x * random(), low.y + size.y * random()), peak);
  }
  EXPECT_GT(dark, 100);  // and it does tell black places
}

}  // namespace
}  // namespace ninefold
