// worth.h: what each candidate is worth to the picture, as sixteen of the camera points judge.
//
//   v_j = sum_i c_ij / (C_i + mean(C)/10),   C_i = sum_j c_ij
//
//   c_ij   pi times the radiance that candidate j adds to judge i; 0 if it is hidden
//
// So a VPL counts by its share of each point's light, not by its power: a bright place in the
// picture, such as a lit room behind a door, is one place among others. That is what the eye and
// relative errors ask for. C is known: the candidates are many.
//
// Source:  Segovia et al. 2006, section 3.2, where v_j = sum_i c_ij.
// Threads: one set's working memory.   Errors: none.
#pragma once

#include <vector>

#include "common/gi/bidirectional/camera_points.h"
#include "common/gi/vpl/vpl_gather.h"

namespace ninefold {

class Worth {
 public:
  Worth(const Transport& transport, const CameraPoints& camera);

  // The next candidate: a VPL of the set `lights`, with this power.
  void add(const VplSet& lights, const Vpl& vpl, VplGatherScratch& scratch, RayCounts& rays);
  // The judges that the last candidate's light reaches, as bits.
  uint32_t reached() const { return reached_; }
  // Multiplies what the last candidate adds.
  void scale(float factor);

  // The share of what candidate j would add to the judges, were nothing hidden, that it does add; 0
  // where nothing is known.
  float seen(size_t j) const { return seen_[j]; }
  // v_j of all candidates, in their order.
  std::vector<float> values() const;

 private:
  const Transport& t_;
  Receivers judges_;
  std::vector<Vec3> shares_;  // one a judge
  uint32_t reached_ = 0;
  std::vector<float> added_;  // c_ij, candidate by candidate
  std::vector<float> seen_;   // by candidate
};

}  // namespace ninefold
