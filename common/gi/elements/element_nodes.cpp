#include "common/gi/elements/element_nodes.h"

#include <bit>
#include <numeric>
#include <utility>

#include "common/sampling/hash.h"

namespace ninefold {
namespace {

constexpr float kSmooth = 0.8f;  // least cosine between normals of a smooth surface: 37 degrees

uint64_t bits(float x) { return std::bit_cast<uint32_t>(x == 0 ? 0.0f : x); }

}  // namespace

size_t SmoothCorners::Hash::operator()(const Vec3& p) const {
  return hashWords(bits(p.x), bits(p.y), bits(p.z));
}

uint32_t SmoothCorners::nodeOf(Vec3 position, Vec3 normal) {
  std::vector<Corner>& corners = places_[position];
  for (const Corner& corner : corners)
    if (glm::dot(corner.normal, normal) >= kSmooth) return corner.node;
  corners.push_back({normal, nodes_});
  return nodes_++;
}

size_t EdgePoints::Hash::operator()(const Key& key) const {
  return hashWords(uint64_t{key.low} << 32 | key.high, uint64_t{key.k} << 32 | key.n);
}

uint32_t EdgePoints::nodeOf(uint32_t from, uint32_t to, uint32_t k, uint32_t n) {
  if (k == 0) return from;
  if (k == n) return to;
  if (from > to) std::swap(from, to), k = n - k;
  const auto [found, isNew] = edges_.try_emplace({from, to, k, n}, next_);
  if (isNew) ++next_;
  return found->second;
}

Connected::Connected(size_t nodes) : parents_(nodes) {
  std::iota(parents_.begin(), parents_.end(), 0u);
}

uint32_t Connected::find(uint32_t node) {
  while (parents_[node] != node) node = parents_[node] = parents_[parents_[node]];
  return node;
}

// The smaller becomes the name, whatever the order.
void Connected::join(uint32_t a, uint32_t b) {
  a = find(a), b = find(b);
  parents_[std::max(a, b)] = std::min(a, b);
}

}  // namespace ninefold
