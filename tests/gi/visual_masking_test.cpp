#include "common/gi/selective/visual_masking.h"

#include <gtest/gtest.h>

#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

// A square of 8 m with a checkerboard of `tiles` x `tiles`, dark and bright.
Scene board(int tiles, uint8_t dark) {
  SceneBuilder b;
  b.quad(b.material(testing::matte(Vec3(1))), Vec3(0), Vec3(8, 0, 0), Vec3(0, 0, -8));
  Scene scene = b.build();
  TextureImage image{"board", tiles, tiles, 1, false, {}};
  for (int y = 0; y < tiles; ++y)
    for (int x = 0; x < tiles; ++x) image.texels.push_back((x + y) % 2 == 0 ? 200 : dark);
  scene.images.push_back(image);
  scene.materials[0].baseColorMap.image = 0, scene.materials[0].baseColorMap.nearest = true;
  scene.meshes[0].uv0 = {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
  return scene;
}

float elevation(const Scene& scene, Metres h) { return VisualMasking(scene, h).elevation(0); }

TEST(VisualMasking, WithoutContrastNothingIsHidden) {
  EXPECT_EQ(elevation(board(8, 200), 0.1f), 1);
  SceneBuilder plain;
  plain.box(plain.material(testing::matte(Vec3(0.5f))), Vec3(-1), Vec3(1), true);
  EXPECT_EQ(elevation(plain.build(), 0.1f), 1);
}

// c = (200 - 100)/(200 + 100) = 1/3: (1 + (6^(-7/3) (6^(10/3) 33.3)^0.7)^4)^(1/4) = 11.6.
TEST(VisualMasking, FollowsTheContrastOfTilesThatAreLargerThanElements) {
  EXPECT_NEAR(elevation(board(8, 100), 0.02f), 11.6, 1);
  EXPECT_GT(elevation(board(8, 20), 0.02f), elevation(board(8, 100), 0.02f) + 5);
}

// Tiles of 0.03 m are averaged over elements of 1 m: what is left of their contrast is chance.
TEST(VisualMasking, LeavesOutWhatElementsCannotShow) {
  const Scene fine = board(256, 20);
  EXPECT_LT(elevation(fine, 1), 0.6f * elevation(fine, 0.003f));
}

// Twice as large in the scene, with elements twice as large: the same.
TEST(VisualMasking, GoesByTheSizeInTheScene) {
  Scene scene = board(16, 100);
  const float before = elevation(scene, 0.4f);
  scene.instances[0].toWorld = DMat4(2);
  scene.instances[0].toWorld[3][3] = 1;
  EXPECT_NEAR(elevation(scene, 0.8f), before, 1e-3f * before);
}

// What is known of an earlier state saves work and changes nothing.
TEST(VisualMasking, IsTheSameWhateverWasKnownBefore) {
  const Scene read = board(16, 100);
  const VisualMasking known(read, 0.4f);
  Scene moved = read, larger = read;
  moved.instances[0].toWorld[3].x = 2;
  larger.instances[0].toWorld[0][0] = 3;
  for (const Scene& scene : {read, moved, larger})
    EXPECT_EQ(VisualMasking(scene, 0.4f, &known).elevation(0), elevation(scene, 0.4f));
  EXPECT_EQ(VisualMasking(read, 0.1f, &known).elevation(0), elevation(read, 0.1f));
}

}  // namespace
}  // namespace ninefold
