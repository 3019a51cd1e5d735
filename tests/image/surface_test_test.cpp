// What the discontinuity buffer takes for one surface, on shapes where the right answer is known.
#include "common/image/surface_test.h"

#include <gtest/gtest.h>

#include "common/image/patch_filter.h"
#include "tests/image/synthetic.h"

namespace ninefold {
namespace {

using namespace synthetic;

constexpr int kWidth = 320, kHeight = 240;
const TileGrid kGrid(kWidth, kHeight, {3, 3});

Point wallAt(Vec3 direction, float depth) {
  return plane(direction, Vec3(0, 0, -depth), Vec3(0, 0, 1));
}
Point ground(Vec3 direction) { return plane(direction, Vec3(0, -1, 0), Vec3(0, 1, 0)); }

// Additive noise that differs from light set to light set and sums to zero over the nine.
float setNoise(int x, int y) { return 0.1f * static_cast<float>(kGrid.phaseOfPixel(x, y) - 4); }

// All pixels of the window of (x, y) belong to the part of the shape.
bool windowWithin(const Shape& shape, int part, int x, int y) {
  const CameraRays rays(camera(), kWidth, kHeight);
  for (int v = y - 1; v <= y + 1; ++v)
    for (int u = x - 1; u <= x + 1; ++u) {
      const Point p =
          shape(rays.direction(static_cast<float>(u) + 0.5f, static_cast<float>(v) + 0.5f));
      if (u < 0 || v < 0 || u >= kWidth || v >= kHeight || p.distance == 0 || p.part != part)
        return false;
    }
  return true;
}

struct Count {
  int pixels = 0, noisy = 0;
  double share() const { return static_cast<double>(noisy) / pixels; }
};

// Of the pixels whose window lies within a part, how many keep noise that the window could cancel.
Count keptNoise(const Shape& shape, int part, SurfaceTest test, bool jitter) {
  const Light smooth = [](int, int, const Point& p) { return 2 + p.normal.y; };
  const Light noisy = [&](int x, int y, const Point& p) {
    return smooth(x, y, p) + setNoise(x, y);
  };
  const RgbImage clean = composed(frameOfShape(kGrid, shape, smooth, jitter), test);
  const RgbImage got = composed(frameOfShape(kGrid, shape, noisy, jitter), test);
  Count count;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      if (windowWithin(shape, part, x, y)) {
        const size_t i = clean.at(x, y);
        ++count.pixels;
        count.noisy += std::abs(got.pixels.r[i] - clean.pixels.r[i]) > 1e-5f;
      }
  return count;
}

// Pixels on either side of an edge between part 0 and part 1 that got light from the other side.
Count crossings(const Shape& shape, SurfaceTest test) {
  const Light light = [](int, int, const Point& p) { return static_cast<float>(p.part); };
  const Frame frame = frameOfShape(kGrid, shape, light, true);
  const RgbImage image = composed(frame, test);
  Count count;
  for (const float red : image.pixels.r) {
    ++count.pixels;
    count.noisy += red != 0 && red != 0.25f;
  }
  return count;
}

TEST(SurfaceTest, FoldsAllSetsAllOverASphere) {
  const Shape shape = [](Vec3 v) { return sphere(v, Vec3(0, 0, -3), 0.5f); };
  const Count kept = keptNoise(shape, 0, SurfaceTest::surface, false);
  EXPECT_GT(kept.pixels, 5000);
  EXPECT_EQ(kept.noisy, 0);
  EXPECT_LT(keptNoise(shape, 0, SurfaceTest::surface, true).share(), 0.02);
}

TEST(SurfaceTest, FoldsSmallSpheresWhereThePapersThresholdsGiveUp) {
  const Shape shape = [](Vec3 v) { return sphere(v, Vec3(0.2f, 0.1f, -3), 0.06f); };
  EXPECT_EQ(keptNoise(shape, 0, SurfaceTest::surface, false).noisy, 0);
  EXPECT_GT(keptNoise(shape, 0, SurfaceTest::paper, false).share(), 0.2);
}

TEST(SurfaceTest, FoldsAFloorUpToTheHorizonWithSpreadFilmPositions) {
  const Count surface = keptNoise(ground, 0, SurfaceTest::surface, true);
  const Count paper = keptNoise(ground, 0, SurfaceTest::paper, true);
  EXPECT_LT(surface.share(), 0.03);  // the last rows, within kGrazingCosine of the horizon
  EXPECT_LT(surface.noisy, paper.noisy);
}

// What an orthographic camera sees, 2 m high, along -z: a place is told by x and y alone.
Camera plan() {
  Camera plan = camera();
  plan.orthographicHeight = 2;
  return plan;
}
Frame planOf(const std::function<Point(Vec3 start)>& shape, const Light& light) {
  const CameraRays rays(plan(), kWidth, kHeight);
  return frameOf(kGrid, kDiffuseBit, 0, [&](TileResult& out, size_t i, int x, int y) {
    const Point point =
        shape(rays.start(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
    LayerPlanes& layer = out.layers[kDiffuse];
    layer.distance[i] = point.distance;
    set(layer.normal, i, point.normal);
    set(layer.irradiance, i, Vec3(light(x, y, point)));
    if (point.distance > 0) set(layer.reflectance, i, Vec3(0.25f));
  });
}

// A steep roof: its depth grows by more than a pixel from pixel to pixel.
TEST(SurfaceTest, FoldsARoofSeenByParallelRays) {
  const Vec3 normal = glm::normalize(Vec3(-3, 0, 1));
  const auto roof = [&](Vec3 start) {
    Point p;
    p.distance = 6 - 3 * start.x, p.normal = normal;
    return p;
  };
  const Light noisy = [](int x, int y, const Point&) { return 2 + setNoise(x, y); };
  PatchFilter filter(SurfaceTest::surface);
  const RgbImage image = composed(planOf(roof, noisy), filter, plan());
  for (int y = 1; y + 1 < kHeight; ++y)
    for (int x = 1; x + 1 < kWidth; ++x)
      ASSERT_NEAR(image.pixels.r[image.at(x, y)], 0.5f, 1e-5f) << x << ", " << y;
}

TEST(SurfaceTest, StopsAtAStepSeenByParallelRays) {
  const auto step = [](Vec3 start) {
    Point p;
    p.part = start.x < 0.1f;
    p.distance = p.part == 1 ? 50 : 50.05f, p.normal = Vec3(0, 0, 1);
    return p;
  };
  const Light light = [](int, int, const Point& p) { return static_cast<float>(p.part); };
  PatchFilter filter(SurfaceTest::surface);
  for (const float red : composed(planOf(step, light), filter, plan()).pixels.r)
    ASSERT_TRUE(red == 0 || red == 0.25f) << red;
}

TEST(SurfaceTest, StopsAtAStepBetweenParallelWalls) {
  const Shape step = [](Vec3 v) {
    Point p = v.x < 0.1f ? wallAt(v, 2) : wallAt(v, 2.1f);
    p.part = v.x < 0.1f;
    return p;
  };
  EXPECT_EQ(crossings(step, SurfaceTest::surface).noisy, 0);
}

TEST(SurfaceTest, StopsAtTheEdgeOfABookOnATable) {
  const Shape book = [](Vec3 v) {
    Point top = plane(v, Vec3(0, -0.95f, 0), Vec3(0, 1, 0));
    const bool on = std::abs(top.position.x) < 0.3f && std::abs(top.position.z + 2.5f) < 0.2f;
    return nearer(on ? top : Point{}, ground(v));
  };
  EXPECT_EQ(crossings(book, SurfaceTest::surface).noisy, 0);
}

TEST(SurfaceTest, StopsWhereAWallMeetsTheFloor) {
  const Shape corner = [](Vec3 v) { return nearer(ground(v), wallAt(v, 4)); };
  for (const SurfaceTest test : {SurfaceTest::paper, SurfaceTest::surface})
    EXPECT_EQ(crossings(corner, test).noisy, 0);
}

TEST(SurfaceTest, StopsAtTheOutlineOfASphere) {
  const Shape overFloor = [](Vec3 v) {
    return nearer(sphere(v, Vec3(0.1f, -0.5f, -3), 0.4f), ground(v));
  };
  const Shape beforeWall = [](Vec3 v) {
    return nearer(sphere(v, Vec3(0.1f, -0.1f, -3), 0.4f), wallAt(v, 4));
  };
  EXPECT_EQ(crossings(overFloor, SurfaceTest::surface).noisy, 0);
  EXPECT_EQ(crossings(beforeWall, SurfaceTest::surface).noisy, 0);
}

TEST(SurfaceTest, IsSymmetricBitForBit) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform(-1, 1);
  int accepted = 0;
  for (int i = 0; i < 100000; ++i) {
    const auto guide = [&] {
      const float u = 1 + 0.01f * uniform(random);
      return SurfaceGuide{u, 0.01f * uniform(random), 0.01f * uniform(random),
                          0.005f + 0.005f * uniform(random)};
    };
    const SurfaceGuide p = guide(), q = guide();
    const float dx = static_cast<float>(random() % 5) - 2,
                dy = static_cast<float>(random() % 5) - 2;
    const bool forwards = predictsNeighbour(p, q, dx, dy);
    ASSERT_EQ(forwards, predictsNeighbour(q, p, -dx, -dy));
    ASSERT_EQ(similarDistance(p.u, q.u, 0.01f), similarDistance(q.u, p.u, 0.01f));
    accepted += forwards;
  }
  EXPECT_GT(accepted, 10000);
  EXPECT_LT(accepted, 90000);
}

TEST(SurfaceTest, NeverAcceptsAPixelWithoutSurface) {
  const SurfaceGuide none{0, 0, 0, 0}, p{1, 0, 0, 100};
  EXPECT_FALSE(predictsNeighbour(none, none, 1, 0));
  EXPECT_FALSE(predictsNeighbour(p, none, 1, 0));
  EXPECT_FALSE(predictsNeighbour(none, p, 1, 0));
  EXPECT_FALSE(similarDistance(0, 0, 1));
}

TEST(SurfaceTest, LetsNothingThatIsNotFiniteCrossAnEdge) {
  const Shape corner = [](Vec3 v) { return nearer(ground(v), wallAt(v, 4)); };
  const Light light = [](int, int, const Point& p) { return p.part == 1 ? NAN : 4.0f; };
  const RgbImage image = composed(frameOfShape(kGrid, corner, light), SurfaceTest::surface);
  int finite = 0, expected = 0;
  const CameraRays rays(camera(), kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const Point p =
          corner(rays.direction(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
      expected += p.part == 0;
      finite += image.pixels.g[image.at(x, y)] == 1;
    }
  EXPECT_EQ(finite, expected);
}

TEST(SurfaceTest, KeepsChainsApartInMirrors) {
  const uint8_t layers = kDiffuseBit | kReflectionBit;
  for (const SurfaceTest test : {SurfaceTest::paper, SurfaceTest::surface}) {
    const Frame frame = frameOf(kGrid, layers, 0, [](TileResult& out, size_t i, int x, int) {
      LayerPlanes& layer = out.layers[kReflection];
      layer.distance[i] = 2;
      set(layer.normal, i, Vec3(0, 1, 0));
      set(layer.reflectance, i, Vec3(0.25f));
      layer.chain[i] = x < 100 ? 17 : 18;
      set(layer.irradiance, i, Vec3(x < 100 ? 0.0f : 1.0f));
    });
    for (const float red : composed(frame, test).pixels.r) ASSERT_TRUE(red == 0 || red == 0.25f);
  }
}

}  // namespace
}  // namespace ninefold
