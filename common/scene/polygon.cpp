#include "common/scene/polygon.h"

namespace ninefold {
namespace {

using DVec2 = glm::dvec2;

// Newell's normal: twice the vector area.
DVec3 vectorArea(std::span<const Vec3> corners) {
  DVec3 sum(0);
  const DVec3 o(corners[0]);
  for (size_t i = 0; i < corners.size(); ++i)
    sum += glm::cross(DVec3(corners[i]) - o, DVec3(corners[(i + 1) % corners.size()]) - o);
  return sum;
}

// The corners in a plane where the polygon turns counter-clockwise.
std::vector<DVec2> flattened(std::span<const Vec3> corners) {
  const DVec3 n = vectorArea(corners);
  const DVec3 size = glm::abs(n);
  const int drop = size.x > size.y && size.x > size.z ? 0 : (size.y > size.z ? 1 : 2);
  const int u = (drop + 1) % 3, v = (drop + 2) % 3;
  const bool swap = n[drop] < 0;
  std::vector<DVec2> flat;
  flat.reserve(corners.size());
  for (const Vec3& c : corners) {
    const DVec2 p(c[u], c[v]);
    flat.push_back(swap ? DVec2(p.y, p.x) : p);
  }
  return flat;
}

double turn(DVec2 a, DVec2 b, DVec2 c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool isInside(DVec2 p, DVec2 a, DVec2 b, DVec2 c) {
  return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
}

// True if the triangle at place i of `ring` lies inside the polygon and holds no other corner.
bool isEar(const std::vector<DVec2>& flat, const std::vector<uint32_t>& ring, size_t i) {
  const size_t n = ring.size();
  const uint32_t ia = ring[(i + n - 1) % n], ib = ring[i], ic = ring[(i + 1) % n];
  const DVec2 a = flat[ia], b = flat[ib], c = flat[ic];
  if (turn(a, b, c) <= 0) return false;
  return std::none_of(ring.begin(), ring.end(), [&](uint32_t j) {
    const DVec2 p = flat[j];
    return p != a && p != b && p != c && isInside(p, a, b, c);
  });
}

}  // namespace

std::vector<Triangle> triangulate(std::span<const Vec3> corners) {
  std::vector<uint32_t> ring(corners.size());
  for (uint32_t i = 0; i < ring.size(); ++i) ring[i] = i;
  std::vector<Triangle> triangles;
  const std::vector<DVec2> flat = flattened(corners);
  size_t triesLeft = 64 * ring.size(), misses = 0, i = 1;
  while (ring.size() > 3 && misses < ring.size() && triesLeft-- > 0) {
    i %= ring.size();
    if (!isEar(flat, ring, i)) {
      ++i, ++misses;
      continue;
    }
    const size_t n = ring.size();
    triangles.emplace_back(ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]);
    ring.erase(ring.begin() + static_cast<ptrdiff_t>(i));
    misses = 0;
  }
  for (size_t k = 1; k + 1 < ring.size(); ++k)
    triangles.emplace_back(ring[0], ring[k], ring[k + 1]);
  return triangles;
}

}  // namespace ninefold
