// visual_masking.h: how far textures hide a wrong light. It may be T_e times as large before it is
// seen.
//
//   T_e = (1 + (k1 (k2 c/c_0)^s)^b)^(1/b)     k1 = 6^(-7/3), k2 = 6^(10/3), s = 0.7, b = 4
//   c     contrast of the texture as far as light of mesh elements can be mistaken for it: standard
//         deviation over mean of the luminance of squares of side h; finer features do not count
//   c_0   contrast that is just seen: 1 %, what eyes can do at best
//
// T_e decides about the order in which photons are traced, and about nothing else.
//
// Source:  Daly, "The Visible Differences Predictor", 1993 (threshold elevation); Dmitriev et al.
//          2002, 5.3 (band limited by the mesh).
// Proved:  tests/gi/visual_masking_test.cpp.
// Threads: const after construction.   Errors: none.
#pragma once

#include <vector>

#include "common/scene/scene.h"

namespace ninefold {

class VisualMasking {
 public:
  // h: of mesh elements [m]. `before`: of another state of the scene, or null: it saves work alone.
  VisualMasking(const Scene& scene, Metres h, const VisualMasking* before = nullptr);
  // T_e, at least 1.
  float elevation(uint32_t instance) const { return known_[instance].elevation; }

 private:
  struct Known {
    DMat3 linear;    // of the instance
    uint64_t shape;  // Mesh::shape
    float elevation;
  };
  Metres h_;
  std::vector<Known> known_;  // by instance
};

}  // namespace ninefold
