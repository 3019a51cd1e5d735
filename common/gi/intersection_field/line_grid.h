// line_grid.h: the fixed set of lines that visibility is kept for, and how much each stands for.
//
// w is up, u one of the two horizontal axes, v the other; all count from the middle of the bounds.
// A line's horizontal part has a slope |a| <= 1 against u, so that the families u = x and u = z
// have all of them. Its vertical part lies in the slice v = a u + b, and has two forms, too:
//
//   flat    v = a u + b   w = c u + d   |c| <= 1   t = u   direction D = (1, a, c)
//   steep   v = a u + b   u = c w + d   |c| <= 1   t = w   direction D = (c, a c, 1)
//
// So two families of two forms have every direction once. (As published there are flat ones alone,
// and directions near the vertical are missing: a fifth of all light between floor and ceiling.)
//
//   a_i = (2 i + 1)/N - 1, c_k alike             N directions of each
//   b_j, d_m                                     M distances, evenly over the box's shadow
//
// N and M without a common divisor: else lines of different slopes meet in the same points.
//
// The invariant measure of lines is not uniform on this grid. With dA the area across and dw the
// solid angle it is
//
//   dmu = cos dA dw = J da db dc dd    J = 1/|D|^4 (flat), |c|/|D|^4 (steep)
//
// and the line (i, j, k, m) stands for mu = J times its cell [m^2 sr]. So for any surface of area A
// the sum of mu over the lines that cross it tends to pi A. For steep lines |c| is the cell's mean.
//
// Units:   metres of the scene.   Source: Ren, Hua, Chen and Bao 2005, 4.1; the measure: Santalo,
//          "Integral Geometry and Geometric Probability", 1976.
// Proved:  tests/gi/line_grid_test.cpp.
// Threads: const after construction.   Errors: none; settings are checked before.
#pragma once

#include <cstdint>
#include <vector>

#include "common/math/bounds.h"
#include "common/math/vec.h"

namespace ninefold {

// Place of a line in the grid.
struct GridLine {
  int family = 0;    // 0: u = x, 1: u = z
  int i = 0, j = 0;  // of a, b
  int k = 0;         // of c: 0..N-1 flat, N..2N-1 steep
  int m = 0;         // of d
  bool operator==(const GridLine&) const = default;
};

class LineGrid {
 public:
  static constexpr int kFamilies = 2;
  static constexpr int kMostDirections = 128, kMostDistances = 255;  // numbers fit into 32 bits

  LineGrid(const Bounds& bounds, int directions, int distances);
  bool operator==(const LineGrid&) const = default;

  int directions() const { return n_; }  // N
  int distances() const { return m_; }   // M
  bool isSteep(int k) const { return k >= n_; }
  float slope(int i) const { return slopes_[static_cast<size_t>(i < n_ ? i : i - n_)]; }

  // b or d of number n is (n - offset) / scale: the place of a value x among them is
  // x scale + offset.
  struct Places {
    float scale, offset;
    bool operator==(const Places&) const = default;
  };
  const Places& placesOfB(int family, int i) const { return b_[index(family, i, n_)]; }
  const Places& placesOfD(int family, int k) const { return d_[index(family, k, 2 * n_)]; }

  uint32_t slices() const { return static_cast<uint32_t>(kFamilies * n_ * m_); }
  uint32_t lines() const { return slices() * static_cast<uint32_t>(2 * n_ * m_); }
  uint32_t sliceOf(int family, int i, int j) const {
    return static_cast<uint32_t>((family * n_ + i) * m_ + j);
  }
  uint32_t numberOf(const GridLine& line) const;
  GridLine lineOf(uint32_t number) const;

  // A point of the scene as (u, v, w) of a family, and back.
  Vec3 toFamily(int family, Vec3 p) const;
  Vec3 fromFamily(int family, Vec3 p) const;
  Vec3 pointAt(const GridLine& line, float t) const;
  Vec3 pointIn(const GridLine& line, float u, float w) const;  // of its slice
  Vec3 directionOf(const GridLine& line) const;                // unit, t grows
  float lengthOf(const GridLine& line) const;                  // |D|: metres for each of t
  double measureOf(const GridLine& line) const;                // mu [m^2 sr]

  // What lies nearer along a line counts as being in one place [m].
  float rounding() const { return 0x1p-16f * size_; }

 private:
  static size_t index(int family, int i, int count) {
    return static_cast<size_t>(family * count + i);
  }

  int n_, m_;
  Vec3 centre_;
  float size_;  // the largest half side [m]
  std::vector<float> slopes_;
  std::vector<Places> b_, d_;
};

}  // namespace ninefold
