#include "common/gi/photon_map/photon_tree.h"

#include "common/math/bounds.h"

namespace ninefold {
namespace {

// Points on the left of the root if all levels of the heap but the last are full.
size_t leftOf(size_t count) {
  const size_t full = std::bit_floor(count + 1) - 1;  // in the full levels
  const size_t half = full / 2, last = count - full, widest = (full + 1) / 2;
  return half + std::min(last, widest);
}

int longestSide(const NamedPoint* points, size_t count) {
  Vec3 low = points[0].position, high = low;
  for (size_t i = 1; i < count; ++i) {
    low = glm::min(low, points[i].position);
    high = glm::max(high, points[i].position);
  }
  const Vec3 size = high - low;
  return size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
}

}  // namespace

PhotonTree::PhotonTree(std::vector<NamedPoint> points) : nodes_(points.size()) {
  if (!points.empty()) build(points.data(), points.size(), 0);
}

void PhotonTree::build(NamedPoint* points, size_t count, size_t node) {
  const int axis = longestSide(points, count);
  const size_t left = leftOf(count);
  std::nth_element(points, points + left, points + count,
                   [axis](const NamedPoint& a, const NamedPoint& b) {
                     return a.position[axis] < b.position[axis];
                   });
  nodes_[node] = {points[left].position, points[left].name, axis};
  if (left > 0) build(points, left, 2 * node + 1);
  if (left + 1 < count) build(points + left + 1, count - left - 1, 2 * node + 2);
}

}  // namespace ninefold
