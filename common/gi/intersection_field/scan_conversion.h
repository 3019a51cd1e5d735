// scan_conversion.h: where lines meet a triangle, found for whole rows of lines at once.
//
//   for each slice (a, b) that crosses the triangle: the segment in which they cross
//   for each c: the d's whose lines meet the segment: x0 <= m < x1, with x the places of its ends
//   on them t is an arithmetic progression: one LineRun
//
//   x = (w - c u) scale + offset (flat), (u - c w) scale + offset (steep)
//
// No line slips between triangles that share an edge, and none meets both: slices take a corner to
// be on one side or the other, the end of a segment is worked out from the edge alone, and a run
// takes its lower end and leaves its upper.
//
// Units:   corners as (u, v, w) of the family, line_grid.h.
// Source:  Ren et al. 2005, 4.2 (Figure 3) and 4.3 (runs).
// Proved:  tests/gi/line_field_test.cpp.
// Threads: pure functions.   Errors: none; a triangle without area has no runs.
#pragma once

#include <array>
#include <cstdint>

#include "common/gi/intersection_field/line_grid.h"

namespace ninefold {

// Lines m = first, first + 1, ... of one (a, b, c) that meet one triangle, at
// t(m) = t + (m - first) step.
struct LineRun {
  uint32_t triangle = 0;
  uint16_t first = 0, count = 0;
  float t = 0, step = 0;

  bool has(int m) const { return m >= first && m < first + count; }
  float at(int m) const { return t + static_cast<float>(m - first) * step; }
};
static_assert(sizeof(LineRun) == 16);

// A triangle's corners, by rising place among the b's of one (family, i).
struct SlicedTriangle {
  std::array<Vec3, 3> corners;
  std::array<float, 3> places;

  SlicedTriangle(const LineGrid& grid, int family, int i, const std::array<Vec3, 3>& at);
  // The slices that cross it: first <= j < end.
  int first(const LineGrid& grid) const;
  int end(const LineGrid& grid) const;
};

// The segment of a slice in a triangle: its two ends as (u, w).
struct Segment {
  Vec2 p, q;
};
Segment segmentOf(const SlicedTriangle& triangle, int j);

// The runs of a segment for all c: run k is of c_k, and has no line where its count is 0.
void runsOf(const LineGrid& grid, int family, const Segment& segment, uint32_t triangle,
            std::array<LineRun, 2 * LineGrid::kMostDirections>& runs);

}  // namespace ninefold
