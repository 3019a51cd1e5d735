// What the last touch is guided by, from the layers of a frame.
#include "common/image/guide_film.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/image/synthetic.h"

namespace ninefold {
namespace {

using namespace synthetic;

// Frames of a wall ahead with a mirror in its right half. `distance` of the wall.
Frame wallWithMirror(const TileGrid& grid, float distance) {
  return frameOf(grid, kDiffuseBit | kReflectionBit, 0, [&](TileResult& out, size_t i, int x, int) {
    const bool isMirror = x >= grid.width() / 2;
    LayerPlanes& layer = out.layers[isMirror ? kReflection : kDiffuse];
    layer.distance[i] = isMirror ? 2 * distance : distance;
    set(layer.normal, i, isMirror ? Vec3(0, 0, -1) : Vec3(0, 0, 1));
    set(layer.irradiance, i, Vec3(1));
    set(layer.reflectance, i, Vec3(0.3f, 0.6f, 0.9f) / std::numbers::pi_v<float>);
  });
}

void add(const Frame& frame, GuideFilm& film) {
  Patch patch;
  for (int tile = 0; tile < frame.grid().tiles(); ++tile) {
    fill(patch, frame, tile);
    film.addPatch(patch);
  }
  film.frameDone();
}

TEST(GuideFilm, IsTheMeanOfWhatTheFirstLayerWithASurfaceShows) {
  const TileGrid grid(130, 20, {3, 3});
  GuideFilm film(grid.width(), grid.height());
  add(wallWithMirror(grid, 1), film);
  add(wallWithMirror(grid, 2), film);
  const DenoiseGuides guides = film.guides();
  for (int y = 0; y < grid.height(); ++y)
    for (int x = 0; x < grid.width(); ++x) {
      const bool isMirror = x >= grid.width() / 2;
      const auto i = static_cast<size_t>(y * grid.width() + x);
      ASSERT_NEAR(guides.albedo[i], 0.6f, 1e-6f) << x << " " << y;
      ASSERT_FLOAT_EQ(guides.nearness[i], isMirror ? 0.375f : 0.75f) << x << " " << y;
      ASSERT_EQ(get(guides.normal, i), Vec3(0, 0, isMirror ? -1 : 1)) << x << " " << y;
    }
}

TEST(GuideFilm, ForgetsWhenCleared) {
  const TileGrid grid(20, 20, {3, 3});
  GuideFilm film(grid.width(), grid.height());
  add(wallWithMirror(grid, 1), film);
  film.clear();
  add(wallWithMirror(grid, 4), film);
  EXPECT_FLOAT_EQ(film.guides().nearness[0], 0.25f);
}

}  // namespace
}  // namespace ninefold
