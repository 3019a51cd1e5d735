// whole_tile.h: what a task of a whole tile covers when clients filter: all phases, and the pixels
// around them that the filter's window reaches.
//
// Proved:  tests/sampling/whole_tile_test.cpp.   Threads: pure.
#pragma once

#include <array>

#include "common/sampling/interleave.h"

namespace ninefold {

// The tile's pixels, as a rectangle of the picture.
inline TaskRect pixelsOf(const TileGrid& grid, int tile) {
  const auto [n, m] = grid.interleave();
  TaskRect r;
  r.i0 = tile % grid.columns() * kTaskSide * n, r.j0 = tile / grid.columns() * kTaskSide * m;
  r.width = std::min(grid.width() - r.i0, kTaskSide * n);
  r.height = std::min(grid.height() - r.j0, kTaskSide * m);
  return r;
}

// A phase's sub-pixels in the tile and in the n x m windows around the tile's pixels. A window
// reaches (n-1)/2 pixels to the left and n/2 to the right; up and down likewise with m.
inline TaskRect rectWithBorder(const TileGrid& grid, int tile, int phase) {
  const TaskRect inner = grid.rect(tile, phase);
  const auto [n, m] = grid.interleave();
  const int px = phase % n, py = phase / n;
  const int left = px >= n - (n - 1) / 2 ? 1 : 0, right = px < n / 2 ? 1 : 0;
  const int up = py >= m - (m - 1) / 2 ? 1 : 0, down = py < m / 2 ? 1 : 0;
  TaskRect r;
  r.i0 = std::max(0, inner.i0 - left), r.j0 = std::max(0, inner.j0 - up);
  r.width = std::max(0, std::min(inner.i0 + kTaskSide + right, grid.subWidth(phase)) - r.i0);
  r.height = std::max(0, std::min(inner.j0 + kTaskSide + down, grid.subHeight(phase)) - r.j0);
  return r;
}

// What rectWithBorder has more than the tile's own rectangle: above, below, left and right of it.
inline std::array<TaskRect, 4> borderOf(const TileGrid& grid, int tile, int phase) {
  const TaskRect all = rectWithBorder(grid, tile, phase), own = grid.rect(tile, phase);
  const int right = own.i0 + own.width, below = own.j0 + own.height;
  return {TaskRect{all.i0, all.j0, all.width, own.j0 - all.j0},
          TaskRect{all.i0, below, all.width, all.j0 + all.height - below},
          TaskRect{all.i0, own.j0, own.i0 - all.i0, own.height},
          TaskRect{right, own.j0, all.i0 + all.width - right, own.height}};
}

}  // namespace ninefold
