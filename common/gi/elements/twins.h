// twins.h: triangles of a mesh that lie on an earlier one with the same corners.
//
// Threads: const after construction.   Errors: none.   Proved: tests/gi/element_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>

#include "common/scene/scene.h"

namespace ninefold {

class Twins {
 public:
  struct Twin {
    uint32_t triangle = 0;                       // the earlier one
    std::array<uint8_t, 3> corners = {0, 1, 2};  // which of its corners each of ours is
    bool isTurned = false;                       // it looks the other way
  };

  explicit Twins(const Mesh& mesh);
  // Null: it is no later twin.
  const Twin* find(uint32_t triangle) const {
    const auto found = twins_.find(triangle);
    return found == twins_.end() ? nullptr : &found->second;
  }

 private:
  std::unordered_map<uint32_t, Twin> twins_;
};

}  // namespace ninefold
