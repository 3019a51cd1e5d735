// interleave.h: which pixels make up a task. The image is cut into tiles. The n x m interleaving
// pattern gives each pixel a *phase*, its place in the pattern. A task is (frame, tile, phase).
//
// All pixels of phase p form a *sub-plane*, a small image of its own. A task is a rectangle of one
// sub-plane, rows top to bottom.
//
//   sub-pixel (i, j) of phase p  =  pixel (p mod n + n i, p / n + m j)
//   light set of phase p         =  (p + rotation) mod K
//
// Over K rotations every pixel meets every set. While the picture moves the rotation stays put.
//
// Source:  Keller and Heidrich, "Interleaved Sampling", 2001.
// Proved:  tests/sampling/interleave_test.cpp.   Threads: plain values.
#pragma once

#include <algorithm>
#include <cstdint>

namespace ninefold {

struct Interleave {
  int n = 3;  // columns of the pattern, 1..16
  int m = 3;  // rows of the pattern, 1..16
  int sets() const { return n * m; }
  bool operator==(const Interleave&) const = default;
};

// A full task is 32 x 32 pixels of one phase; part of the pixel class.
inline constexpr int kTaskSide = 32;

// A rectangle of a phase's sub-plane.
struct TaskRect {
  int i0 = 0, j0 = 0;         // first sub-pixel in the sub-plane
  int width = 0, height = 0;  // 0..kTaskSide each; 0 when the phase has no pixel in the tile
  int count() const { return width * height; }
};

class TileGrid {
 public:
  TileGrid(int width, int height, Interleave interleave)
      : width_(width), height_(height), interleave_(interleave) {}

  int columns() const { return ceilDivide(width_, kTaskSide * interleave_.n); }
  int rows() const { return ceilDivide(height_, kTaskSide * interleave_.m); }
  int tiles() const { return columns() * rows(); }
  int tasks() const { return tiles() * interleave_.sets(); }
  int width() const { return width_; }
  int height() const { return height_; }
  Interleave interleave() const { return interleave_; }

  int phaseOfPixel(int x, int y) const {
    return x % interleave_.n + interleave_.n * (y % interleave_.m);
  }
  int subWidth(int phase) const {
    return ceilDivide(std::max(0, width_ - phase % interleave_.n), interleave_.n);
  }
  int subHeight(int phase) const {
    return ceilDivide(std::max(0, height_ - phase / interleave_.n), interleave_.m);
  }
  TaskRect rect(int tile, int phase) const {
    TaskRect r;
    r.i0 = (tile % columns()) * kTaskSide;
    r.j0 = (tile / columns()) * kTaskSide;
    r.width = std::clamp(subWidth(phase) - r.i0, 0, kTaskSide);
    r.height = std::clamp(subHeight(phase) - r.j0, 0, kTaskSide);
    return r;
  }
  int pixelX(int phase, int i) const { return phase % interleave_.n + interleave_.n * i; }
  int pixelY(int phase, int j) const { return phase / interleave_.n + interleave_.m * j; }

 private:
  static int ceilDivide(int a, int b) { return (a + b - 1) / b; }
  int width_, height_;
  Interleave interleave_;
};

inline int lightSetOfPhase(int phase, uint32_t rotation, int sets) {
  return static_cast<int>((static_cast<uint32_t>(phase) + rotation) % static_cast<uint32_t>(sets));
}

}  // namespace ninefold
