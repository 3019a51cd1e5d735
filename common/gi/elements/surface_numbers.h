// surface_numbers.h: one number for each side of each triangle of a scene.
//
//   2 (first triangle of the instance + triangle) + 1 on the back
//
// Meshes do not change under edits, so that numbers stay what they are.
// Threads: const after construction.   Errors: throws Error for more than 2^31 - 1 triangles.
#pragma once

#include <algorithm>
#include <vector>

#include "common/base/error.h"
#include "common/scene/scene.h"

namespace ninefold {

class SurfaceNumbers {
 public:
  struct Surface {
    uint32_t instance = 0, triangle = 0;
    bool isBack = false;
  };

  explicit SurfaceNumbers(const Scene& scene) {
    uint64_t next = 0;
    for (const Instance& instance : scene.instances) {
      first_.push_back(static_cast<uint32_t>(next));
      next += scene.meshes[static_cast<size_t>(instance.mesh)].triangles.size();
      if (next >= uint64_t{1} << 31)
        fail("the scene has more than {} triangles: this method cannot name them all", next - 1);
    }
    end_ = static_cast<uint32_t>(next);
  }

  uint32_t numberOf(const Surface& s) const {
    return 2 * (first_[s.instance] + s.triangle) + (s.isBack ? 1 : 0);
  }
  bool isThere(uint32_t number) const { return number / 2 < end_; }
  Surface surfaceOf(uint32_t number) const {
    const uint32_t triangle = number / 2;
    const auto after = std::upper_bound(first_.begin(), first_.end(), triangle);
    const auto instance = static_cast<uint32_t>(after - first_.begin()) - 1;
    return {instance, triangle - first_[instance], (number & 1) != 0};
  }

 private:
  std::vector<uint32_t> first_;  // triangle, by instance
  uint32_t end_ = 0;
};

}  // namespace ninefold
