#include "common/gi/intersection_field/line_grid.h"

namespace ninefold {
namespace {

Vec3 turned(int family, Vec3 p) { return family == 0 ? Vec3(p.x, p.z, p.y) : Vec3(p.z, p.x, p.y); }

// M places over [-reach, reach], each in the middle of its part.
LineGrid::Places placesOver(float reach, int count) {
  const float scale = static_cast<float>(count) / (2 * reach);
  return {scale, reach * scale - 0.5f};
}

}  // namespace

LineGrid::LineGrid(const Bounds& bounds, int directions, int distances)
    : n_(directions), m_(distances), centre_(0.5f * (bounds.low + bounds.high)), size_(0) {
  Vec3 half = 0.5f * (bounds.high - bounds.low);
  size_ = maxComponent(half);
  half = glm::max(half, Vec3(1e-3f * size_));  // a flat scene has some thickness
  for (int i = 0; i < n_; ++i)
    slopes_.push_back(static_cast<float>(2 * i + 1) / static_cast<float>(n_) - 1);
  for (int family = 0; family < kFamilies; ++family) {
    const Vec3 side = turned(family, half);
    for (const float a : slopes_) b_.push_back(placesOver(side.y + std::abs(a) * side.x, m_));
    for (const float c : slopes_) d_.push_back(placesOver(side.z + std::abs(c) * side.x, m_));
    for (const float c : slopes_) d_.push_back(placesOver(side.x + std::abs(c) * side.z, m_));
  }
}

uint32_t LineGrid::numberOf(const GridLine& line) const {
  const uint32_t page = sliceOf(line.family, line.i, line.j) * static_cast<uint32_t>(2 * n_) +
                        static_cast<uint32_t>(line.k);
  return page * static_cast<uint32_t>(m_) + static_cast<uint32_t>(line.m);
}

GridLine LineGrid::lineOf(uint32_t number) const {
  const auto n = static_cast<uint32_t>(n_), m = static_cast<uint32_t>(m_);
  GridLine line;
  line.m = static_cast<int>(number % m), number /= m;
  line.k = static_cast<int>(number % (2 * n)), number /= 2 * n;
  line.j = static_cast<int>(number % m), number /= m;
  line.i = static_cast<int>(number % n);
  line.family = static_cast<int>(number / n);
  return line;
}

Vec3 LineGrid::toFamily(int family, Vec3 p) const { return turned(family, p - centre_); }

Vec3 LineGrid::fromFamily(int family, Vec3 p) const {
  return centre_ + (family == 0 ? Vec3(p.x, p.z, p.y) : Vec3(p.y, p.z, p.x));
}

Vec3 LineGrid::pointAt(const GridLine& line, float t) const {
  const Places& d = placesOfD(line.family, line.k);
  const float along = slope(line.k) * t + (static_cast<float>(line.m) - d.offset) / d.scale;
  return isSteep(line.k) ? pointIn(line, along, t) : pointIn(line, t, along);
}

Vec3 LineGrid::pointIn(const GridLine& line, float u, float w) const {
  const Places& b = placesOfB(line.family, line.i);
  const float across = (static_cast<float>(line.j) - b.offset) / b.scale;
  return fromFamily(line.family, Vec3(u, slope(line.i) * u + across, w));
}

Vec3 LineGrid::directionOf(const GridLine& line) const {
  const float a = slope(line.i), c = slope(line.k);
  const Vec3 d = isSteep(line.k) ? Vec3(c, a * c, 1) : Vec3(1, a, c);
  return glm::normalize(line.family == 0 ? Vec3(d.x, d.z, d.y) : Vec3(d.y, d.z, d.x));
}

float LineGrid::lengthOf(const GridLine& line) const {
  const float a = slope(line.i), c = slope(line.k);
  return std::sqrt(isSteep(line.k) ? 1 + c * c + a * a * c * c : 1 + a * a + c * c);
}

double LineGrid::measureOf(const GridLine& line) const {
  const double step = 2.0 / n_;  // of a and c
  const double length = double{lengthOf(line)};
  const double cell = step * step / double{placesOfB(line.family, line.i).scale} /
                      double{placesOfD(line.family, line.k).scale};
  const double c = std::abs(double{slope(line.k)});
  // The mean of |c| over a cell is |c|, but for the one that holds 0.
  const double shrink = !isSteep(line.k) ? 1 : c < 0.5 * step ? 0.25 * step + c * c / step : c;
  return shrink * cell / (length * length * length * length);
}

}  // namespace ninefold
