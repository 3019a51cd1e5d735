#include "common/image/patch_filter.h"

#include <gtest/gtest.h>

#include "common/image/aov_film.h"
#include "tests/image/synthetic.h"

namespace ninefold {
namespace {

using namespace synthetic;

Point wall(Vec3 direction) { return plane(direction, Vec3(0, 0, -2), Vec3(0, 0, 1)); }

// A wall whose texture changes at every pixel, under an even light, with a highlight.
TEST(PatchFilter, LeavesTexturesAndHighlightsSharp) {
  const CameraRays rays(camera(), 96, 64);
  const auto texture = [](int x, int y) {
    return 0.01f * static_cast<float>((x * 5 + y * 3) % 31);
  };
  const auto highlight = [](int x, int y) { return x == 40 && y == 20 ? 7.0f : 0.0f; };
  const TileGrid grid(96, 64, {3, 3});
  const RgbImage beauty =
      composed(frameOf(grid, kDiffuseBit, 0, [&](TileResult& out, size_t i, int x, int y) {
        const Point p =
            wall(rays.direction(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
        LayerPlanes& layer = out.layers[kDiffuse];
        layer.distance[i] = p.distance;
        set(layer.normal, i, p.normal);
        set(layer.irradiance, i, Vec3(1, 2, 3));
        set(layer.reflectance, i, Vec3(texture(x, y)));
        set(layer.unfiltered, i, Vec3(highlight(x, y)));
      }));
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 96; ++x) {
      const Vec3 expected = texture(x, y) * Vec3(1, 2, 3) + Vec3(highlight(x, y));
      ASSERT_EQ(beauty.rgb(beauty.at(x, y)), expected) << x << ", " << y;
    }
}

TEST(PatchFilter, AddsTheLayersThatAreThere) {
  for (const uint8_t layers : {kDiffuseBit, uint8_t(kDiffuseBit | kTransmissionBit),
                               uint8_t(kDiffuseBit | kReflectionBit | kTransmissionBit)}) {
    const TileGrid grid(31, 17, {2, 3});
    const RgbImage beauty =
        composed(frameOf(grid, layers, 0, [&](TileResult& out, size_t i, int, int) {
          for (int l = 0; l < kLayers; ++l)
            if (hasLayer(layers, l)) {
              LayerPlanes& layer = out.layers[static_cast<size_t>(l)];
              set(layer.reflectance, i, Vec3(0.25f));
              set(layer.irradiance, i, Vec3(static_cast<float>(4 << l)));
              set(layer.unfiltered, i, Vec3(static_cast<float>(100 << l)));
            }
        }));
    float expected = 0;
    for (int l = 0; l < kLayers; ++l)
      if (hasLayer(layers, l)) expected += static_cast<float>(101 << l);
    for (size_t i = 0; i < beauty.count(); ++i) ASSERT_EQ(beauty.rgb(i), Vec3(expected));
  }
}

TEST(PatchFilter, TakesNothingFromOneFrameToTheNext) {
  const TileGrid grid(64, 48, {3, 3});
  const auto lit = [&](float e) {
    return frameOfShape(grid, wall,
                        [=](int x, int, const Point&) { return e + static_cast<float>(x % 7); });
  };
  PatchFilter filter(SurfaceTest::surface);
  const RgbImage first = composed(lit(1), filter);
  const RgbImage other = composed(lit(5), filter);
  const RgbImage again = composed(lit(1), filter);
  EXPECT_NE(first, other);
  EXPECT_EQ(first, again);
}

// U is what no neighbours give, F what all of them do.
TEST(PatchFilter, ComposesWithAndWithoutNeighboursAtOnce) {
  const TileGrid grid(64, 48, {3, 3});
  const Frame frame = frameOfShape(
      grid, wall, [](int x, int y, const Point&) { return static_cast<float>(x * y % 7); });
  PatchFilter filter(SurfaceTest::surface);
  Patch patch;
  fill(patch, frame, 0);
  RgbImage none, all, unfiltered, filtered;
  filter.compose(patch, camera(), 0, none);
  filter.compose(patch, camera(), 1, all);
  filter.compose(patch, camera(), 1, filtered, &unfiltered);
  EXPECT_TRUE(unfiltered == none);
  EXPECT_TRUE(filtered == all);
  EXPECT_FALSE(all == none);
}

// A patch that has held a mirror takes a tile of which one pixel mirrors: the other phases' results
// have nothing in that layer.
TEST(PatchFilter, TakesNothingFromTheTileThatThePatchHeldBefore) {
  const TileGrid grid(96, 96, {3, 3});
  const auto mirroring = [&](const auto& isMirror) {
    return frameOf(grid, kDiffuseBit | kReflectionBit, 0,
                   [&](TileResult& out, size_t i, int x, int y) {
                     if (!isMirror(x, y)) return;
                     LayerPlanes& layer = out.layers[kReflection];
                     set(layer.reflectance, i, Vec3(0.25f));
                     set(layer.irradiance, i, Vec3(4));
                     set(layer.unfiltered, i, Vec3(100));
                   });
  };
  const auto isOne = [](int x, int y) { return x == 40 && y == 20; };
  Patch patch;
  fill(patch, mirroring([](int, int) { return true; }), 0);
  fill(patch, mirroring(isOne), 0);
  PatchFilter filter(SurfaceTest::surface);
  RgbImage beauty;
  filter.compose(patch, camera(), 1, beauty);
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 96; ++x)
      ASSERT_EQ(beauty.rgb(beauty.at(x, y)), Vec3(isOne(x, y) ? 101.0f : 0.0f)) << x << ", " << y;
}

// Two walls, one before the other, whose edge is between the columns 47 and 48.
TEST(PatchFilter, ShowsWhatShareOfTheWindowCounts) {
  const auto step = [](Vec3 v) {
    return v.x < 0 ? wall(v) : plane(v, Vec3(0, 0, -5), Vec3(0, 0, 1));
  };
  const TileGrid grid(96, 64, {3, 3});
  const Frame frame = frameOfShape(grid, step, [](int, int, const Point&) { return 1.0f; });
  const auto shares = [&](float weight) {
    PatchFilter filter(SurfaceTest::surface);
    Patch patch;
    RgbImage tile, all;
    all.reset(96, 64);
    for (int t = 0; t < grid.tiles(); ++t) {
      fill(patch, frame, t);
      filter.compose(patch, camera(), weight, tile);
      filter.paintShares(patch, weight, tile);
      for (int y = 0; y < tile.height; ++y)
        for (int x = 0; x < tile.width; ++x)
          set(all.pixels, all.at(patch.x0() + x, patch.y0() + y), tile.rgb(tile.at(x, y)));
    }
    return all;
  };
  const RgbImage full = shares(1), half = shares(0.5f), none = shares(0);
  const auto ninths = [](const RgbImage& image, int x, int y) {
    return 9 * image.rgb(image.at(x, y)).x;
  };
  EXPECT_FLOAT_EQ(ninths(full, 20, 30), 9);
  EXPECT_FLOAT_EQ(ninths(full, 47, 30), 6);  // one column is behind the edge
  EXPECT_FLOAT_EQ(ninths(full, 48, 30), 6);
  EXPECT_FLOAT_EQ(ninths(full, 30, 0), 6);  // at the border of the picture
  EXPECT_FLOAT_EQ(ninths(full, 0, 0), 4);
  EXPECT_FLOAT_EQ(ninths(full, 47, 63), 4);
  EXPECT_FLOAT_EQ(ninths(half, 20, 30), 5);
  EXPECT_FLOAT_EQ(ninths(none, 20, 30), 1);
}

TEST(AovFilm, NamesItsChannelsAndAveragesThem) {
  const TileGrid grid(41, 23, {3, 3});
  const uint8_t extras = kAlbedoPlane | kNormalPlane | kDepthPlane | kObjectPlane | kCausticPlane;
  AovFilm film(grid, extras);
  PatchFilter filter(SurfaceTest::surface);
  for (int n = 0; n < 4; ++n) {  // every pixel meets a surface in frames 0 and 1 only
    const bool hit = n < 2;
    const Frame frame =
        frameOf(grid, kDiffuseBit, extras, [&](TileResult& out, size_t i, int x, int y) {
          set(out.extras.albedo, i, Vec3(0.25f * static_cast<float>(n), 0, 1));
          set(out.extras.normal, i, hit ? (n == 0 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)) : Vec3(0));
          set(out.extras.caustic, i, Vec3(static_cast<float>(x)));
          out.extras.depth[i] = hit ? 2 + static_cast<float>(n) : 0;
          out.extras.object[i] = static_cast<uint32_t>(y + n);
          set(out.layers[kDiffuse].irradiance, i, Vec3(static_cast<float>(n)));
        });
    RgbImage beauty;
    Patch patch;
    for (int tile = 0; tile < grid.tiles(); ++tile) {
      fill(patch, frame, tile);
      filter.compose(patch, camera(), 1, beauty);
      film.addPatch(patch);
    }
    film.frameDone();
  }
  std::string names;
  for (const Channel& channel : film.channels()) names += channel.name + " ";
  EXPECT_EQ(names,
            "albedo.R albedo.G albedo.B N.x N.y N.z Z irradiance.R irradiance.G irradiance.B "
            "caustic.R caustic.G caustic.B objectId ");
  const std::vector<Channel> channels = film.channels();
  const size_t at = 11 * 41 + 30;
  const auto value = [&](size_t c) { return channels[c].values.at(at); };
  EXPECT_FLOAT_EQ(value(0), 0.375f);
  EXPECT_FLOAT_EQ(value(3), std::sqrt(0.5f));
  EXPECT_FLOAT_EQ(value(6), 2.5f);
  EXPECT_FLOAT_EQ(value(7), 1.5f);
  EXPECT_FLOAT_EQ(value(10), 30);
  EXPECT_FLOAT_EQ(value(13), 14);
}

// A picture may be written while a frame has come in parts.
TEST(AovFilm, PartsOfAFrameMakeNoPixelBrighter) {
  const TileGrid grid(41, 23, {3, 3});
  AovFilm film(grid, kAlbedoPlane);
  PatchFilter filter(SurfaceTest::surface);
  const Frame frame =
      frameOf(grid, kDiffuseBit, kAlbedoPlane, [&](TileResult& out, size_t i, int, int) {
        set(out.extras.albedo, i, Vec3(0.5f));
        set(out.layers[kDiffuse].irradiance, i, Vec3(2));
      });
  RgbImage beauty;
  Patch patch;
  for (int n = 0; n < grid.tiles() + 1; ++n) {  // the first tile twice
    if (n == grid.tiles()) film.frameDone();
    fill(patch, frame, n % grid.tiles());
    filter.compose(patch, camera(), 1, beauty);
    film.addPatch(patch);
  }
  for (const Channel& channel : film.channels())
    for (const float value : channel.values)
      ASSERT_EQ(value, channel.name.starts_with("albedo") ? 0.5f : 2.0f) << channel.name;
}

}  // namespace
}  // namespace ninefold
