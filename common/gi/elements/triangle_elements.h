// triangle_elements.h: which of a triangle's elements a point lies in, and its weights there.
//
//   points   (i, j) at u = i/n, v = j/n, in rows of j; each names a node
//   element  (i, j), (i+1, j), (i, j+1), or, if it is upper, (i+1, j+1), (i, j+1), (i+1, j)
//
// Threads: const.   Owner: refers to the block that it is of.   Errors: none.
// Proved:  tests/gi/element_test.cpp.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace ninefold {

struct TriangleElements {
  struct Cell {
    uint32_t i, j;
    bool isUpper;
  };
  struct Place {
    std::array<uint32_t, 3> nodes;
    std::array<float, 3> weights;
    Cell cell;
  };

  uint32_t n;
  const uint32_t* points;  // their nodes

  static uint32_t pointOf(uint32_t i, uint32_t j, uint32_t n) {
    return j * (n + 1) - j * (j - 1) / 2 + i;
  }
  static uint32_t pointsOf(uint32_t n) { return (n + 1) * (n + 2) / 2; }

  uint32_t numberOf(const Cell& cell) const {
    return cell.j * (2 * n - cell.j) + 2 * cell.i + cell.isUpper;
  }
  std::array<uint32_t, 3> nodesOf(const Cell& cell) const {
    const uint32_t low = pointOf(cell.i, cell.j, n), above = pointOf(cell.i, cell.j + 1, n);
    if (cell.isUpper) return {points[above + 1], points[above], points[low + 1]};
    return {points[low], points[low + 1], points[above]};
  }
  // u, v: barycentrics of the second and third corner.
  Place at(float u, float v) const {
    const float x = std::max(u, 0.0f) * static_cast<float>(n);
    const float y = std::max(v, 0.0f) * static_cast<float>(n);
    const uint32_t j = std::min(static_cast<uint32_t>(y), n - 1);
    const uint32_t i = std::min(static_cast<uint32_t>(x), n - 1 - j);
    const float fx = std::clamp(x - static_cast<float>(i), 0.0f, 1.0f);
    const float fy = std::clamp(y - static_cast<float>(j), 0.0f, 1.0f);
    const float left = 1 - fx - fy;
    const Cell cell{i, j, left < 0 && i + j + 2 <= n};
    std::array<float, 3> weights = {left, fx, fy};
    if (cell.isUpper)
      weights = {-left, 1 - fx, 1 - fy};
    else if (left < 0)  // past the long side by rounding
      weights = {0, fx / (fx + fy), fy / (fx + fy)};
    return {nodesOf(cell), weights, cell};
  }
};

}  // namespace ninefold
