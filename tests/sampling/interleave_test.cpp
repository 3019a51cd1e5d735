// Tasks cut the image into pieces: every pixel belongs to exactly one, whatever the sizes.
#include "common/sampling/interleave.h"

#include <gtest/gtest.h>

#include <vector>

namespace ninefold {
namespace {

struct Case {
  int width, height;
  Interleave interleave;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const auto& [w, h] : {std::pair{1, 1}, {7, 5}, {2, 33}, {96, 96}, {97, 95}, {641, 479}}) {
    for (int n = 1; n <= 8; ++n) {
      for (const int m : {1, n, 9 - n}) all.push_back({w, h, {n, m}});
    }
  }
  all.push_back({7, 5, {16, 16}});  // a pattern larger than the image
  all.push_back({1, 300, {16, 1}});
  return all;
}

TEST(TileGrid, EveryPixelIsInExactlyOneTask) {
  for (const Case& c : cases()) {
    const TileGrid grid(c.width, c.height, c.interleave);
    std::vector<int> visits(static_cast<size_t>(c.width) * static_cast<size_t>(c.height));
    for (int task = 0; task < grid.tasks(); ++task) {
      const int tile = task / c.interleave.sets(), phase = task % c.interleave.sets();
      const TaskRect r = grid.rect(tile, phase);
      ASSERT_LE(r.width, kTaskSide);
      ASSERT_LE(r.height, kTaskSide);
      for (int j = r.j0; j < r.j0 + r.height; ++j) {
        for (int i = r.i0; i < r.i0 + r.width; ++i) {
          const int x = grid.pixelX(phase, i), y = grid.pixelY(phase, j);
          ASSERT_TRUE(x >= 0 && x < c.width && y >= 0 && y < c.height);
          ASSERT_EQ(grid.phaseOfPixel(x, y), phase);
          ++visits[static_cast<size_t>(y) * static_cast<size_t>(c.width) + static_cast<size_t>(x)];
        }
      }
    }
    for (const int v : visits) {
      ASSERT_EQ(v, 1) << c.width << "x" << c.height << " by " << c.interleave.n << "x"
                      << c.interleave.m;
    }
  }
}

// The tasks of a tile cover the same square of the image, so that a tile is complete by itself.
TEST(TileGrid, TasksOfOneTileStayInsideIt) {
  for (const Case& c : cases()) {
    const TileGrid grid(c.width, c.height, c.interleave);
    const int tileWidth = kTaskSide * c.interleave.n, tileHeight = kTaskSide * c.interleave.m;
    for (int tile = 0; tile < grid.tiles(); ++tile) {
      for (int phase = 0; phase < c.interleave.sets(); ++phase) {
        const TaskRect r = grid.rect(tile, phase);
        if (r.count() == 0) continue;
        for (const int i : {r.i0, r.i0 + r.width - 1}) {
          ASSERT_EQ(grid.pixelX(phase, i) / tileWidth, tile % grid.columns());
        }
        for (const int j : {r.j0, r.j0 + r.height - 1}) {
          ASSERT_EQ(grid.pixelY(phase, j) / tileHeight, tile / grid.columns());
        }
      }
    }
  }
}

TEST(LightSetOfPhase, OverAllRotationsAPixelMeetsEverySetOnce) {
  for (const int sets : {1, 4, 9, 64}) {
    for (int phase = 0; phase < sets; ++phase) {
      std::vector<int> met(static_cast<size_t>(sets));
      for (uint32_t rotation = 100; rotation < 100 + static_cast<uint32_t>(sets); ++rotation) {
        ++met[static_cast<size_t>(lightSetOfPhase(phase, rotation, sets))];
      }
      for (const int count : met) EXPECT_EQ(count, 1);
    }
  }
}

}  // namespace
}  // namespace ninefold
