// photon_tree.h: the photons' k-d tree, balanced to the left and laid out as a heap: the children
// of node i are 2i + 1 and 2i + 2. Each node halves its part along the longest side of the part's
// box. It is built anew after each change, O(n log n).
//
// Source:  Jensen 2001, 6.4 and chapter 5; Jozwowski 2002, 4.2 (balanced each frame; what he needs
//          photon_location for are names here).
// Proved:  tests/gi/photon_search_test.cpp (the same neighbours as photon_cells.h and brute force).
// Threads: const after construction.   Errors: none; an empty tree finds nothing.
#pragma once

#include <vector>

#include "common/gi/photon_map/nearest.h"

namespace ninefold {

class PhotonTree {
 public:
  PhotonTree() = default;
  explicit PhotonTree(std::vector<NamedPoint> points);

  size_t size() const { return nodes_.size(); }

  // Calls visit(d2, name) for points with d^2 <= r2, and perhaps some beyond. It returns what r2 is
  // from now on, not more than before.
  template <typename Visit>
  void near(Vec3 x, float r2, Visit&& visit) const {
    // The far sides that wait, with their squared distance along the axis.
    struct Waiting {
      size_t node;
      float d2;
    };
    Waiting stack[kMostLevels];
    int waiting = 0;
    size_t node = 0;
    for (;;) {
      while (node < nodes_.size()) {
        const Node& n = nodes_[node];
        const float along = x[n.axis] - n.position[n.axis];
        const size_t nearer = 2 * node + (along < 0 ? 1 : 2), farther = 4 * node + 3 - nearer;
        if (farther < nodes_.size()) stack[waiting++] = {farther, along * along};
        const float d2 = squaredDistance(n.position, x);
        if (d2 <= r2) r2 = visit(d2, n.name);
        node = nearer;
      }
      while (waiting > 0 && stack[waiting - 1].d2 > r2) --waiting;
      if (waiting == 0) return;
      node = stack[--waiting].node;
    }
  }

 private:
  static constexpr int kMostLevels = 34;  // of 2^32 nodes
  struct Node {
    Vec3 position{0};
    uint32_t name = 0;
    int axis = 0;
  };
  void build(NamedPoint* points, size_t count, size_t node);

  std::vector<Node> nodes_;
};

}  // namespace ninefold
