// bounds.h: axis-aligned boxes and the sphere around one. Empty until a point is added.
#pragma once

#include <limits>

#include "common/math/vec.h"

namespace ninefold {

struct Bounds {
  Vec3 low{std::numeric_limits<float>::infinity()};
  Vec3 high{-std::numeric_limits<float>::infinity()};

  void add(Vec3 p) { low = glm::min(low, p), high = glm::max(high, p); }
  bool empty() const { return low.x > high.x; }
  Vec3 centre() const { return 0.5f * low + 0.5f * high; }
  // R of the formulas: half the diagonal [m]; 0 for an empty or one-point box.
  float radius() const { return empty() ? 0.0f : 0.5f * glm::length(high - low); }
};

}  // namespace ninefold
