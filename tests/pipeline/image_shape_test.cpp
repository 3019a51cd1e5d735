// Images of every size and interleaving, patterns larger than the image too, through the whole way
// of a frame.
//
// A wall without albedo emits by a texture of random texels, so that no pixel is like its
// neighbour: it shows U alone, which no filter touches. Where a pixel's sample lies depends on the
// pixel and not on the pattern. So each picture must be the one that single tasks of one row and
// column give, but for the codec's rounding: 1/127.5 of the largest channel (tile_codec.h), for a
// mirror's layer likewise.
#include <gtest/gtest.h>

#include <random>

#include "tests/gi/make_scene.h"
#include "tests/gi/render.h"
#include "tests/pipeline/one_process.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

// The wall fills the view; a mirror ball before it shows another one behind the eye.
Scene patternedWalls() {
  SceneBuilder b;
  const int wall = b.material(testing::matte(Vec3(0), Vec3(1)));
  b.quad(wall, Vec3(-4, -4, -2), Vec3(8, 0, 0), Vec3(0, 8, 0));
  b.quad(wall, Vec3(4, -4, 2), Vec3(-8, 0, 0), Vec3(0, 8, 0));
  b.sphere(b.material(testing::mirror()), Vec3(0.2f, 0.1f, -1.5f), 0.3f, 16);
  b.camera(Vec3(0), Vec3(0, 0, -1), 1.2f);
  Scene scene = b.build();
  for (size_t i : {0, 1}) scene.meshes[i].uv0 = {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
  std::mt19937 random(1);
  TextureImage texels{"noise", 256, 256, 3, false, std::vector<uint8_t>(3 * 256 * 256)};
  for (uint8_t& texel : texels.texels) texel = static_cast<uint8_t>(random() >> 24);
  scene.images.push_back(std::move(texels));
  TextureUse& use = scene.materials[static_cast<size_t>(wall)].emissionMap;
  use.image = 0, use.nearest = true;
  return scene;
}

struct Size {
  int width, height;
};

TEST(ImageShape, PixelsAreWhereTheyBelongWhateverThePattern) {
  const Scene scene = patternedWalls();
  const Tracer tracer(scene, Isa::automatic);
  for (const Size size : {Size{1, 1}, {7, 5}, {641, 479}}) {
    Settings s;
    s.width = size.width, s.height = size.height, s.interleave = {1, 1};
    s.indirectVpls = 0, s.photons = 0;
    const testing::Rendered expected = testing::render(tracer, s, 1);
    for (const Interleave pattern : {Interleave{1, 1},
                                     {1, 8},
                                     {2, 2},
                                     {3, 3},
                                     {4, 3},
                                     {5, 5},
                                     {6, 6},
                                     {7, 8},
                                     {8, 8},
                                     {16, 16}}) {
      s.interleave = pattern;
      testing::OneProcess way(tracer, s);
      const RgbImage& image = way.nextFrame();
      ASSERT_EQ(image.width, size.width);
      ASSERT_EQ(image.height, size.height);
      size_t wrong = 0;
      for (size_t i = 0; i < image.count(); ++i) {
        const Vec3 e = expected.pixels[i];
        wrong += maxComponent(glm::abs(image.rgb(i) - e)) > maxComponent(e) / 127 ? 1 : 0;
      }
      EXPECT_EQ(wrong, 0u) << size.width << "x" << size.height << ", pattern " << pattern.n << "x"
                           << pattern.m;
    }
  }
}

// What is filtered, E, is the same in every pixel of a wall under an even light: albedo a under a
// sky of radiance 1 seen from one side shows a, in each pixel by the mean over as many frames as
// there are sets.
TEST(ImageShape, EveryPixelMeetsAllLightSets) {
  SceneBuilder b;
  b.quad(b.material(testing::matte(Vec3(0.5f))), Vec3(-1), Vec3(2, 0, 0), Vec3(0, 2, 0));
  PunctualLight sun;
  sun.kind = LightKind::directional, sun.direction = Vec3(0, 0, -1), sun.intensity = Vec3(kPi);
  b.light(sun).camera(Vec3(0), Vec3(0, 0, -1), 0.8f);
  const Scene scene = b.build();
  const Tracer tracer(scene, Isa::automatic);
  for (const Interleave pattern : {Interleave{1, 1}, {3, 3}, {2, 4}, {8, 8}}) {
    Settings s;
    s.width = 7, s.height = 5, s.interleave = pattern, s.directVpls = 1;
    testing::OneProcess way(tracer, s);
    for (int frame = 0; frame < 3; ++frame) {
      const RgbImage& image = way.nextFrame();
      for (size_t i = 0; i < image.count(); ++i)
        ASSERT_NEAR(image.rgb(i).x, 0.5f, 0.01f) << pattern.n << "x" << pattern.m;
    }
  }
}

}  // namespace
}  // namespace ninefold
