#include "common/image/discontinuity_buffer.h"

#include <gtest/gtest.h>

#include "tests/image/synthetic.h"

namespace ninefold {
namespace {

using namespace synthetic;

constexpr SurfaceTest kTests[] = {SurfaceTest::paper, SurfaceTest::surface};

// E' of one layer of a frame, tile by tile.
class Filtered {
 public:
  Filtered(const Frame& frame, SurfaceTest test, float weight = 1, int layer = kDiffuse) {
    const TileGrid& grid = frame.grid();
    image_.reset(grid.width(), grid.height());
    DiscontinuityBuffer buffer(test);
    Patch patch;
    RgbPlane plane;
    plane.resize(Patch::kPixels);
    for (int tile = 0; tile < grid.tiles(); ++tile) {
      fill(patch, frame, tile);
      buffer.prepare(patch, camera());
      for (int p = 0; p < grid.interleave().sets(); ++p) {
        buffer.filter(patch, layer, p, weight, plane);
        forEachInner(patch, p, [&](size_t i, int x, int y) {
          set(image_.pixels, image_.at(x, y), get(plane, i));
        });
      }
    }
  }
  Vec3 rgb(int x, int y) const { return image_.rgb(image_.at(x, y)); }
  float red(int x, int y) const { return rgb(x, y).x; }

 private:
  RgbImage image_;
};

Point wall(Vec3 direction) { return plane(direction, Vec3(0, 0, -2), Vec3(0, 0, 1)); }
Point ground(Vec3 direction) { return plane(direction, Vec3(0, -1, 0), Vec3(0, 1, 0)); }
Point ball(Vec3 direction) { return sphere(direction, Vec3(0.1f, -0.3f, -3), 0.7f); }

// Calls f(x, y) for the pixels that lie, with their whole window, within the image.
template <typename F>
void forInner(const TileGrid& grid, const F& f) {
  const Interleave pattern = grid.interleave();
  for (int y = pattern.m; y < grid.height() - pattern.m; ++y)
    for (int x = pattern.n; x < grid.width() - pattern.n; ++x) f(x, y);
}

TEST(DiscontinuityBuffer, GivesBackAConstantBitForBit) {
  const auto scene = [](Vec3 v) { return nearer(ball(v), ground(v)); };
  for (const float constant : {0.1f, 1.0f / 3, 12345.678f})
    for (const Case& c : kCases)
      for (const SurfaceTest test : kTests) {
        const TileGrid grid(c.width, c.height, c.pattern);
        const auto light = [&](int, int, const Point&) { return constant; };
        const Filtered filtered(frameOfShape(grid, scene, light, true), test);
        for (int y = 0; y < c.height; ++y)
          for (int x = 0; x < c.width; ++x) ASSERT_EQ(filtered.rgb(x, y), Vec3(constant));
      }
}

// Random distances (some without x), normals, E and chains.
Frame randomFrame(const TileGrid& grid, uint8_t layers) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(0, 1);
  return frameOf(grid, layers, 0, [&](TileResult& out, size_t i, int, int) {
    for (int l = 0; l < kLayers; ++l) {
      if (!hasLayer(layers, l)) continue;
      LayerPlanes& layer = out.layers[static_cast<size_t>(l)];
      layer.distance[i] = uniform(random) < 0.1f ? 0 : 1 + 0.1f * uniform(random);
      set(layer.normal, i, glm::normalize(Vec3(0.5f * uniform(random), 0, 1)));
      set(layer.irradiance, i, Vec3(uniform(random), uniform(random), uniform(random)));
      layer.chain[i] = l == kDiffuse ? uint16_t(0) : static_cast<uint16_t>(3 * uniform(random));
    }
  });
}

// E' of one pixel by the definition, in coordinates of the whole image, with the paper's test.
Vec3 byDefinition(const Frame& frame, int layer, int x, int y, float weight) {
  const TileGrid& grid = frame.grid();
  const auto planes = [&](int u, int v) -> const LayerPlanes& {
    return frame.phase(grid.phaseOfPixel(u, v)).layers[static_cast<size_t>(layer)];
  };
  const int n = grid.interleave().n, m = grid.interleave().m;
  const LayerPlanes& p = planes(x, y);
  const size_t i = subIndex(grid, x, y);
  DVec3 sum(0);
  double weights = 1;
  for (int v = std::max(0, y - (m - 1) / 2); v <= std::min(y + m / 2, grid.height() - 1); ++v)
    for (int u = std::max(0, x - (n - 1) / 2); u <= std::min(x + n / 2, grid.width() - 1); ++u) {
      const LayerPlanes& q = planes(u, v);
      const size_t k = subIndex(grid, u, v);
      const float limit = kPaperDistance * std::min(p.distance[i], q.distance[k]);
      if ((u == x && v == y) || p.distance[i] == 0 || q.distance[k] == 0 ||
          std::abs(p.distance[i] - q.distance[k]) > limit || p.chain[i] != q.chain[k] ||
          glm::dot(get(p.normal, i), get(q.normal, k)) < kPaperNormal)
        continue;
      weights += weight;
      sum += double(weight) * DVec3(get(q.irradiance, k) - get(p.irradiance, i));
    }
  return Vec3(DVec3(get(p.irradiance, i)) + sum / weights);
}

TEST(DiscontinuityBuffer, IsTheFormulaForEveryPatternAndSize) {
  const uint8_t layers = kDiffuseBit | kTransmissionBit;
  for (const Case& c : kCases)
    for (const int layer : {int(kDiffuse), int(kTransmission)}) {
      const Frame frame = randomFrame(TileGrid(c.width, c.height, c.pattern), layers);
      const Filtered filtered(frame, SurfaceTest::paper, 0.7f, layer);
      for (int y = 0; y < c.height; ++y)
        for (int x = 0; x < c.width; ++x) {
          const Vec3 wrong = filtered.rgb(x, y) - byDefinition(frame, layer, x, y, 0.7f);
          ASSERT_LT(glm::length(wrong), 2e-6f) << x << ", " << y << " of " << c.width;
        }
    }
}

TEST(DiscontinuityBuffer, CountsEachLightSetOnceOnAnOpenWall) {
  for (const Interleave pattern : {Interleave{3, 3}, Interleave{5, 5}, Interleave{4, 4}}) {
    const TileGrid grid(48, 40, pattern);
    for (int set = 0; set < pattern.sets(); ++set)
      for (const SurfaceTest test : kTests) {
        const auto light = [&](int x, int y, const Point&) {
          return grid.phaseOfPixel(x, y) == set ? 1.0f : 0.0f;
        };
        const Filtered filtered(frameOfShape(grid, wall, light), test);
        forInner(grid, [&](int x, int y) {
          ASSERT_NEAR(filtered.red(x, y), 1.0f / static_cast<float>(pattern.sets()), 1e-6f);
        });
      }
  }
}

// A ball under light that varies smoothly over it, each pixel with an error of its own: uniform, of
// standard deviation 1/sqrt(12). Nine pixels averaged leave a third of that, and the window is too
// small for the light's own curvature to show. Windows overlap, so that some 600 of 5,000 values
// are independent: the root mean square is known to 3 %.
TEST(DiscontinuityBuffer, ACurvedSurfaceUnderSmoothLightLosesItsNoise) {
  const auto big = [](Vec3 v) { return sphere(v, Vec3(0.1f, 0, -3), 0.9f); };
  const TileGrid grid(160, 120, {3, 3});
  std::vector<float> smooth(160 * 120, -1);
  std::mt19937 random(5);
  std::uniform_real_distribution<float> error(-0.5f, 0.5f);
  const auto at = [](int x, int y) { return static_cast<size_t>(y * 160 + x); };
  const auto light = [&](int x, int y, const Point& p) {
    if (p.distance == 0) return 0.0f;
    smooth[at(x, y)] = 3 + p.normal.x + 0.5f * p.normal.y * p.normal.y;
    return smooth[at(x, y)] + error(random);
  };
  const Filtered filtered(frameOfShape(grid, big, light), SurfaceTest::surface);
  double squares = 0;
  int count = 0;
  forInner(grid, [&](int x, int y) {
    for (int v = -1; v <= 1; ++v)
      for (int u = -1; u <= 1; ++u)
        if (smooth[at(x + u, y + v)] < 0) return;
    squares += std::pow(static_cast<double>(filtered.red(x, y) - smooth[at(x, y)]), 2), ++count;
  });
  EXPECT_GT(count, 4000);
  EXPECT_NEAR(std::sqrt(squares / count), std::sqrt(1.0 / 12) / 3, 0.15 * std::sqrt(1.0 / 12) / 3);
}

TEST(DiscontinuityBuffer, CopiesWhenNeighboursWeighNothing) {
  const TileGrid grid(50, 40, {3, 3});
  const Frame frame = randomFrame(grid, kDiffuseBit);
  const Filtered filtered(frame, SurfaceTest::paper, 0);
  for (int p = 0; p < 9; ++p)
    for (int j = 0; j < grid.subHeight(p); ++j)
      for (int i = 0; i < grid.subWidth(p); ++i)
        ASSERT_EQ(filtered.rgb(grid.pixelX(p, i), grid.pixelY(p, j)),
                  get(frame.phase(p).layers[kDiffuse].irradiance,
                      static_cast<size_t>(j * grid.subWidth(p) + i)));
}

TEST(DiscontinuityBuffer, CopiesWithoutATest) {
  for (const Case& c : kCases)
    for (const int layer : {int(kDiffuse), int(kTransmission)}) {
      const TileGrid grid(c.width, c.height, c.pattern);
      const Frame frame = randomFrame(grid, kDiffuseBit | kTransmissionBit);
      const Filtered filtered(frame, SurfaceTest::none, 1, layer);
      for (int y = 0; y < c.height; ++y)
        for (int x = 0; x < c.width; ++x) {
          const TileResult& sub = frame.phase(grid.phaseOfPixel(x, y));
          const LayerPlanes& planes = sub.layers[static_cast<size_t>(layer)];
          ASSERT_EQ(filtered.rgb(x, y), get(planes.irradiance, subIndex(grid, x, y)));
        }
    }
}

// Seams: a pixel comes out the same wherever the tiles' borders lie. Moving a picture's content by
// one sub-pixel moves its tiles' borders over it.
TEST(DiscontinuityBuffer, GivesTheSameBytesWhereverTilesEnd) {
  const TileGrid grid(301, 197, {3, 3});
  const auto content = [](TileResult& out, size_t i, int x, int y) {
    LayerPlanes& layer = out.layers[kDiffuse];
    layer.distance[i] = 2 + 0.01f * static_cast<float>((x / 5 + y / 7) % 11);
    set(layer.normal, i, Vec3(0, 0, 1));
    set(layer.irradiance, i, Vec3(static_cast<float>((x * 7 + y * 13) % 101)));
  };
  const Filtered here(frameOf(grid, kDiffuseBit, 0, content), SurfaceTest::paper);
  const Filtered moved(
      frameOf(grid, kDiffuseBit, 0,
              [&](TileResult& out, size_t i, int x, int y) { content(out, i, x + 3, y + 3); }),
      SurfaceTest::paper);
  for (int y = 1; y < 197 - 4; ++y)
    for (int x = 1; x < 301 - 4; ++x)
      ASSERT_EQ(moved.rgb(x, y), here.rgb(x + 3, y + 3)) << x << ", " << y;
}

}  // namespace
}  // namespace ninefold
