#include "common/sampling/whole_tile.h"

#include <gtest/gtest.h>

namespace ninefold {
namespace {

const TileGrid kGrids[] = {{1, 1, {1, 1}},     {7, 5, {3, 3}},   {97, 95, {3, 3}},
                           {200, 130, {2, 4}}, {64, 64, {1, 1}}, {300, 70, {5, 5}},
                           {641, 479, {3, 3}}, {7, 5, {16, 16}}};

TEST(WholeTile, HoldsThePixelsOfAllPhases) {
  for (const TileGrid& grid : kGrids)
    for (int tile = 0; tile < grid.tiles(); ++tile) {
      int pixels = 0;
      for (int phase = 0; phase < grid.interleave().sets(); ++phase)
        pixels += grid.rect(tile, phase).count();
      EXPECT_EQ(pixelsOf(grid, tile).count(), pixels);
    }
}

// The bordered rectangles of all phases hold exactly the pixels of all windows.
TEST(WholeTile, BordersHoldWhatTheWindowReaches) {
  for (const TileGrid& grid : kGrids) {
    const auto [n, m] = grid.interleave();
    for (int tile = 0; tile < grid.tiles(); ++tile) {
      const TaskRect whole = pixelsOf(grid, tile);
      const int left = std::max(0, whole.i0 - (n - 1) / 2),
                up = std::max(0, whole.j0 - (m - 1) / 2);
      const int right = std::min(grid.width(), whole.i0 + whole.width + n / 2);
      const int down = std::min(grid.height(), whole.j0 + whole.height + m / 2);
      int pixels = 0;
      for (int phase = 0; phase < grid.interleave().sets(); ++phase) {
        const TaskRect r = rectWithBorder(grid, tile, phase);
        pixels += r.count();
        int parts = grid.rect(tile, phase).count();
        for (const TaskRect& strip : borderOf(grid, tile, phase)) parts += strip.count();
        ASSERT_EQ(parts, r.count());
        if (r.count() == 0) continue;
        ASSERT_GE(grid.pixelX(phase, r.i0), left);
        ASSERT_GE(grid.pixelY(phase, r.j0), up);
        ASSERT_LT(grid.pixelX(phase, r.i0 + r.width - 1), right);
        ASSERT_LT(grid.pixelY(phase, r.j0 + r.height - 1), down);
      }
      ASSERT_EQ(pixels, (right - left) * (down - up));
    }
  }
}

}  // namespace
}  // namespace ninefold
