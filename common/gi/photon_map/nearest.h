// nearest.h: the m nearest of the points that are offered, in any order: of equally far ones those
// with the lower names.
//
//   key = d^2 as bits, then the name      floats from 0 up are in the order of their bits
//
// Up to 2 m are kept, then all but the m nearest go: O(1) a point, on the mean.
//
// Threads: one thread's.   Errors: none.   Proved: tests/gi/photon_search_test.cpp.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include "common/math/vec.h"

namespace ninefold {

// A point of an index, and what it is called outside.
struct NamedPoint {
  Vec3 position{0};
  uint32_t name = 0;
};

using NearKey = uint64_t;
inline NearKey nearKey(float d2, uint32_t name) {
  return uint64_t{std::bit_cast<uint32_t>(d2)} << 32 | name;
}
inline float squaredDistance(NearKey key) {
  return std::bit_cast<float>(static_cast<uint32_t>(key >> 32));
}
inline uint32_t nameOf(NearKey key) { return static_cast<uint32_t>(key); }

// The same bits wherever it is asked for.
inline float squaredDistance(Vec3 a, Vec3 b) {
  const Vec3 off = a - b;
  return off.x * off.x + off.y * off.y + off.z * off.z;
}

class Nearest {
 public:
  // The m nearest of those with d^2 <= farthest2.
  void begin(size_t m, float farthest2) {
    m_ = m, keys_.clear();
    limit_ = nearKey(farthest2, std::numeric_limits<uint32_t>::max());
  }
  // Returns beyond which d^2 nothing counts any more.
  float offer(float d2, uint32_t name) {
    const NearKey key = nearKey(d2, name);
    if (key <= limit_) {
      keys_.push_back(key);
      if (keys_.size() >= 2 * m_) drop();
    }
    return squaredDistance(limit_);
  }
  // Those kept, nearest first.
  const std::vector<NearKey>& sorted() {
    std::sort(keys_.begin(), keys_.end());
    if (keys_.size() > m_) keys_.resize(m_);
    return keys_;
  }
  // Of the m-th; negative if there are fewer.
  float farthest2() {
    if (keys_.size() < m_) return -1;
    drop();
    return squaredDistance(keys_.back());
  }

 private:
  void drop() {
    const auto last = keys_.begin() + static_cast<std::ptrdiff_t>(m_) - 1;
    std::nth_element(keys_.begin(), last, keys_.end());
    keys_.resize(m_);
    limit_ = keys_.back();
  }
  std::vector<NearKey> keys_;
  size_t m_ = 0;
  NearKey limit_ = 0;
};

}  // namespace ninefold
