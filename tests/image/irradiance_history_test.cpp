// Light that is reused from frame to frame while the eye moves: it loses its noise, stays what it
// is, and never goes where it does not belong. Floors and walls of known E, seen by an eye that
// walks along them.
#include "common/image/irradiance_history.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/image/synthetic.h"

namespace ninefold::synthetic {
namespace {

const TileGrid kGrid(96, 72, {3, 3});

// What the ray from an eye in a direction meets.
using World = std::function<Point(Vec3 eye, Vec3 direction)>;

Point floorAndWall(Vec3 eye, Vec3 direction) {
  return nearer(plane(direction, Vec3(0, -1, 0) - eye, Vec3(0, 1, 0)),
                plane(direction, Vec3(0, 0, -4) - eye, Vec3(0, 0, 1)));
}

// A screen whose edge is at x = 0, 2 m in front of a wall; part 1 is the wall.
Point screenAndWall(Vec3 eye, Vec3 direction) {
  Point screen = plane(direction, Vec3(0, 0, -2) - eye, Vec3(0, 0, 1));
  if (screen.position.x + eye.x > 0) screen = {};
  return nearer(screen, plane(direction, Vec3(0, 0, -4) - eye, Vec3(0, 0, 1)));
}

// Finishes frames as a live picture does.
class Walk {
 public:
  explicit Walk(World world) : world_(std::move(world)) { filter_.keepIrradiance(true); }

  RgbImage frame(Vec3 eye, const Light& light, bool moving = true, const TileGrid& grid = kGrid) {
    Camera at = camera();
    at.eye = eye;
    const auto shape = [&](Vec3 direction) { return world_(eye, direction); };
    const Frame frame = frameOfShape(grid, shape, light);
    history.begin(at, grid.width(), grid.height());
    RgbImage beauty, tile;
    beauty.reset(grid.width(), grid.height());
    Patch patch;
    for (int t = 0; t < grid.tiles(); ++t) {
      fill(patch, frame, t);
      filter_.compose(patch, at, 0, tile);
      history.blend(patch, filter_, moving, tile);
      for (int y = 0; y < tile.height; ++y)
        for (int x = 0; x < tile.width; ++x)
          set(beauty.pixels, beauty.at(patch.x0() + x, patch.y0() + y), tile.rgb(tile.at(x, y)));
    }
    if (whole) history.frameDone();
    return beauty;
  }

  IrradianceHistory history;
  bool whole = true;  // frames are finished

 private:
  World world_;
  PatchFilter filter_{SurfaceTest::surface};
};

// Where the eye is after some frames: a pixel or two further each time, and a little nearer.
Vec3 eyeAt(int frame) {
  return Vec3(0.021f * static_cast<float>(frame), 0, -0.013f * static_cast<float>(frame));
}

class Noise {
 public:
  explicit Noise(uint32_t seed) : random_(seed) {}
  Light light() {
    return [this](int, int, const Point&) { return 1 + uniform_(random_); };
  }

 private:
  std::mt19937 random_;
  std::uniform_real_distribution<float> uniform_{-0.5f, 0.5f};
};

struct Moments {
  double mean = 0, variance = 0;
};
Moments momentsOf(const RgbImage& image) {
  Moments m;
  for (const float v : image.pixels.r) m.mean += static_cast<double>(v);
  m.mean /= static_cast<double>(image.count());
  for (const float v : image.pixels.r) {
    const double off = static_cast<double>(v) - m.mean;
    m.variance += off * off / static_cast<double>(image.count());
  }
  return m;
}

TEST(IrradianceHistory, EvenLightStaysWhatItIs) {
  Walk walk(floorAndWall);
  const Light even = [](int, int, const Point&) { return 0.7f; };
  for (int i = 0; i < 30; ++i) {
    const RgbImage image = walk.frame(eyeAt(i), even);
    for (const float v : image.pixels.r) ASSERT_NEAR(v, 0.7f * 0.25f, 1e-6f) << "frame " << i;
  }
}

// The mean of kMost frames and the interpolation between four pixels leave a tenth; 1/12 is the
// variance of a single frame, times reflectance squared.
TEST(IrradianceHistory, NoiseFallsAndTheMeanStays) {
  Walk walk(floorAndWall);
  Noise noise(3);
  RgbImage last;
  for (int i = 0; i < 20; ++i) last = walk.frame(eyeAt(i), noise.light());
  const Moments m = momentsOf(last);
  EXPECT_LT(m.variance, 0.15 * 0.0625 / 12);
  EXPECT_NEAR(m.mean, 0.25,
              5 * std::sqrt(m.variance / 1000));  // of 7,000 pixels that are alike by sevens
}

TEST(IrradianceHistory, NothingCrossesAnEdge) {
  Walk walk(screenAndWall);
  const Light light = [](int, int, const Point& p) { return p.part == 1 ? 0.0f : 8.0f; };
  for (int i = 0; i < 20; ++i)
    for (const float v : walk.frame(eyeAt(i), light).pixels.r)
      ASSERT_TRUE(v == 0 || std::abs(v - 2) < 1e-5f) << v << " in frame " << i;
}

// Parallel rays that move along a slanted wall: light that belongs to places stays at them, to a
// third of a pixel. At the rim of the picture not all four pixels around a place are there: to one.
// With each frame the rim is a pixel wider.
TEST(IrradianceHistory, OrthographicPicturesFindTheirPlacesAgain) {
  Camera plan = camera();
  plan.orthographicHeight = 2;
  const float pixel = plan.orthographicHeight / static_cast<float>(kGrid.height());
  IrradianceHistory history;
  PatchFilter filter(SurfaceTest::none);
  filter.keepIrradiance(true);
  const Vec3 normal = glm::normalize(Vec3(-1, 0, 1));
  for (int i = 0; i < 10; ++i) {
    plan.eye = Vec3(0.033f * static_cast<float>(i), 0.01f * static_cast<float>(i), 0);
    const CameraRays rays(plan, kGrid.width(), kGrid.height());
    const auto lightAt = [&](int x, int y) {
      const Vec3 p =
          plan.eye + rays.start(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      return 3 + p.x + 0.5f * p.y;
    };
    const Frame frame =
        frameOf(kGrid, kDiffuseBit, 0, [&](TileResult& out, size_t at, int x, int y) {
          LayerPlanes& layer = out.layers[kDiffuse];
          const float across =
              plan.eye.x + rays.start(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f).x;
          layer.distance[at] = 5 - across;
          set(layer.normal, at, normal);
          set(layer.irradiance, at, Vec3(lightAt(x, y)));
          set(layer.reflectance, at, Vec3(0.25f));
        });
    history.begin(plan, kGrid.width(), kGrid.height());
    Patch patch;
    RgbImage tile;
    for (int t = 0; t < kGrid.tiles(); ++t) {
      fill(patch, frame, t);
      filter.compose(patch, plan, 0, tile);
      history.blend(patch, filter, true, tile);
      for (int y = 0; y < tile.height; ++y)
        for (int x = 0; x < tile.width; ++x) {
          const int px = patch.x0() + x, py = patch.y0() + y;
          const bool isRim =
              std::min({px, py, kGrid.width() - 1 - px, kGrid.height() - 1 - py}) <= i;
          ASSERT_NEAR(tile.pixels.r[tile.at(x, y)], 0.25f * lightAt(px, py),
                      0.25f * pixel * (isRim ? 1 : 1 / 3.0f))
              << i << ": " << px << ", " << py;
        }
    }
    history.frameDone();
  }
}

// The eye steps to the side: what the screen hid until now shows just what this frame says.
TEST(IrradianceHistory, WhatWasHiddenStartsAnew) {
  Walk walk(screenAndWall);
  const auto lit = [](float e) { return [e](int, int, const Point&) { return e; }; };
  for (int i = 0; i < 5; ++i) walk.frame(Vec3(0.1f, 0, 0), lit(8));
  const Vec3 aside(0.5f, 0, 0);
  const RgbImage after = walk.frame(aside, lit(0));
  const CameraRays rays(camera(), kGrid.width(), kGrid.height());
  int uncovered = 0;
  for (int y = 0; y < kGrid.height(); ++y)
    for (int x = 0; x < kGrid.width(); ++x) {
      const Vec3 direction =
          rays.direction(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      const Point p = screenAndWall(aside, direction);
      if (p.part != 1) continue;
      // Where the old eye, at x = 0.1, looked through the screen's plane to see it; more than two
      // pixels behind the edge, since interpolation reaches one.
      const float atScreen = (0.1f + p.position.x + aside.x) / 2;
      if (atScreen > -0.06f) continue;
      ++uncovered;
      ASSERT_EQ(after.pixels.r[after.at(x, y)], 0) << x << ", " << y;
    }
  EXPECT_GT(uncovered, 100);
}

TEST(IrradianceHistory, AfterAnEditNothingOfThePastIsLeft) {
  Walk walk(floorAndWall), fresh(floorAndWall);
  Noise noise(5);
  for (int i = 0; i < 5; ++i) walk.frame(eyeAt(i), noise.light());
  walk.history.forget();
  Noise one(9), two(9);
  const RgbImage a = walk.frame(eyeAt(5), one.light()), b = fresh.frame(eyeAt(5), two.light());
  EXPECT_EQ(a.pixels, b.pixels);
}

// A frame that was given up half-way (its light is wrong here, to be seen) is not looked back at.
TEST(IrradianceHistory, FramesThatWereGivenUpDoNotCount) {
  Walk walk(floorAndWall);
  const auto lit = [](float e) { return [e](int, int, const Point&) { return e; }; };
  walk.frame(eyeAt(0), lit(1));
  walk.whole = false;
  walk.frame(eyeAt(1), lit(8));
  walk.frame(eyeAt(2), lit(8));
  walk.whole = true;
  const RgbImage image = walk.frame(eyeAt(3), lit(1));
  for (const float v : image.pixels.r) ASSERT_NEAR(v, 0.25f, 1e-6f);
}

// A still picture is the film's alone; but the eye that walks on takes along what was seen.
TEST(IrradianceHistory, RestTeachesAndIsLeftAlone) {
  Walk walk(floorAndWall);
  Noise noise(7), same(7);
  for (int i = 0; i < 60; ++i) {
    const RgbImage image = walk.frame(eyeAt(0), noise.light(), false);
    Walk alone(floorAndWall);
    ASSERT_EQ(image.pixels, alone.frame(eyeAt(0), same.light(), false).pixels);
  }
  const Moments m = momentsOf(walk.frame(eyeAt(1), noise.light()));
  EXPECT_LT(m.variance, 0.06 * 0.0625 / 12);  // (1/8)^2 of its own, and 1/60 of what was before
}

TEST(IrradianceHistory, FramesOfAnotherSizeGoOn) {
  Walk walk(floorAndWall);
  Noise noise(11);
  for (int i = 0; i < 12; ++i) walk.frame(eyeAt(i), noise.light());
  const TileGrid half(48, 36, {3, 3});
  const Moments m = momentsOf(walk.frame(eyeAt(12), noise.light(), true, half));
  EXPECT_LT(m.variance, 0.2 * 0.0625 / 12);
}

}  // namespace
}  // namespace ninefold::synthetic
