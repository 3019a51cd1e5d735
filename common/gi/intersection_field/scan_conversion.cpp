#include "common/gi/intersection_field/scan_conversion.h"

#include <utility>

namespace ninefold {
namespace {

// Where the edge from place y0 at a to y1 at b crosses place j, as (u, w). Always from the lower
// end: triangles that share the edge get the same bits.
Vec2 onEdge(const Vec3& a, float y0, const Vec3& b, float y1, float j) {
  const float f = std::clamp((j - y0) / (y1 - y0), 0.0f, 1.0f);
  return Vec2(a.x + f * (b.x - a.x), a.z + f * (b.z - a.z));
}

// The least whole number that is not below x, within [0, most].
int clampedCeil(float x, float most) {
  return static_cast<int>(std::min(std::max(std::ceil(x), 0.0f), most));
}

}  // namespace

SlicedTriangle::SlicedTriangle(const LineGrid& grid, int family, int i,
                               const std::array<Vec3, 3>& at)
    : corners(at), places{} {
  const LineGrid::Places& b = grid.placesOfB(family, i);
  const float a = grid.slope(i);
  for (size_t c = 0; c < 3; ++c) places[c] = (corners[c].y - a * corners[c].x) * b.scale + b.offset;
  const auto order = [&](size_t lower, size_t upper) {
    if (places[upper] >= places[lower]) return;
    std::swap(places[lower], places[upper]);
    std::swap(corners[lower], corners[upper]);
  };
  order(0, 1), order(1, 2), order(0, 1);
}

int SlicedTriangle::first(const LineGrid& grid) const {
  return clampedCeil(places[0], static_cast<float>(grid.distances()));
}

int SlicedTriangle::end(const LineGrid& grid) const {
  return clampedCeil(places[2], static_cast<float>(grid.distances()));
}

Segment segmentOf(const SlicedTriangle& s, int slice) {
  const auto j = static_cast<float>(slice);
  const Vec2 along = onEdge(s.corners[0], s.places[0], s.corners[2], s.places[2], j);
  const bool isLow = j < s.places[1];
  const size_t from = isLow ? 0 : 1;
  return {along,
          onEdge(s.corners[from], s.places[from], s.corners[from + 1], s.places[from + 1], j)};
}

void runsOf(const LineGrid& grid, int family, const Segment& s, uint32_t triangle,
            std::array<LineRun, 2 * LineGrid::kMostDirections>& runs) {
  const int n = grid.directions();
  const auto most = static_cast<float>(grid.distances());
  for (const bool isSteep : {false, true}) {
    const float up = isSteep ? s.p.x : s.p.y, uq = isSteep ? s.q.x : s.q.y;  // across t
    const float tp = isSteep ? s.p.y : s.p.x, tq = isSteep ? s.q.y : s.q.x;
    const int begin = isSteep ? n : 0;
    for (int k = begin; k < begin + n; ++k) {
      const LineGrid::Places& d = grid.placesOfD(family, k);
      const float c = grid.slope(k);
      const float xp = (up - c * tp) * d.scale + d.offset;
      const float xq = (uq - c * tq) * d.scale + d.offset;
      const int first = clampedCeil(std::min(xp, xq), most);
      const int count = clampedCeil(std::max(xp, xq), most) - first;
      const float step = count > 0 ? (tq - tp) / (xq - xp) : 0.0f;
      const float t = tp + (static_cast<float>(first) - xp) * step;
      runs[static_cast<size_t>(k)] = {triangle, static_cast<uint16_t>(first),
                                      static_cast<uint16_t>(count), t, step};
    }
  }
}

}  // namespace ninefold
