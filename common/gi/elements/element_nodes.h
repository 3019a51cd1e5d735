// element_nodes.h: which corners of elements are one node. Private to element_block.cpp.
//
// Threads: one owner.   Errors: none.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "common/math/vec.h"

namespace ninefold {

// Corners of triangles: those in one place whose normals agree are one.
class SmoothCorners {
 public:
  uint32_t nodeOf(Vec3 position, Vec3 normal);
  size_t size() const { return nodes_; }

 private:
  struct Hash {
    size_t operator()(const Vec3& p) const;
  };
  struct Corner {
    Vec3 normal;
    uint32_t node;
  };
  std::unordered_map<Vec3, std::vector<Corner>, Hash> places_;
  uint32_t nodes_ = 0;
};

// Points on the edge between two nodes, cut into n: `k` of them from the first.
class EdgePoints {
 public:
  explicit EdgePoints(uint32_t firstNode) : next_(firstNode) {}
  uint32_t nodeOf(uint32_t from, uint32_t to, uint32_t k, uint32_t n);
  uint32_t add() { return next_++; }  // a point inside of a triangle
  uint32_t size() const { return next_; }

 private:
  struct Key {
    uint32_t low, high, k, n;
    bool operator==(const Key&) const = default;
  };
  struct Hash {
    size_t operator()(const Key& key) const;
  };
  std::unordered_map<Key, uint32_t, Hash> edges_;
  uint32_t next_;
};

// Sets of nodes that elements connect.
class Connected {
 public:
  explicit Connected(size_t nodes);
  void join(uint32_t a, uint32_t b);
  uint32_t find(uint32_t node);

 private:
  std::vector<uint32_t> parents_;
};

}  // namespace ninefold
