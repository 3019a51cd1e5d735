// lamp_pairs.h: what lines say of one lamp: sums over the pairs (p, q) of each node of the mesh
// elements and that lamp.
//
//   a pair   a line that passes a surface at p and the lamp at q, each in front of the other
//   vis      1 if no hit lies between p and q; light that passes straight on through blended
//            surfaces is dimmed (straight_light.h)
//   sums     sum g vis, sum g       for each node and side; a pair counts for its element's three
//                                   nodes by their weights
//   g        mu L/L_max             --field-weights measure; L of the lamp at q
//            1                      alike
//
// mu is the measure of lines, so that pairs have the density dmu = cos_p cos_q/d^2 dA_p dA_q: they
// count as much as they bring light. (As published all pairs count alike, which is wrong by
// cos_p cos_q/d^2 and by the grid's density, however fine it is.)
//
// What hides q at less than an eighth of an element's side before p covers p: a picture on a wall,
// a cupboard on a floor. Nobody sees such a p, and its pairs are left out, as elements would spread
// its dark over what is around.
//
// The lines are those of the lamp's local field (lamp_lines.h): no ray is traced, and lines that
// miss the lamp are not looked at. Sums are whole numbers of 2^-24, exact in any order. So after an
// edit only those lines are looked at that meet what moved, before or now: what they said is taken
// away, what they say is added, and the sums are those of a fresh start to the last bit. How bright
// a lamp is does not count unless it shines unevenly.
//
// Source:  Ren et al. 2005, 5 (VRM) and 6 (influenced lines).
// Proved:  tests/gi/lamp_lines_test.cpp, lamp_visibility_test.cpp, field_edits_test.cpp.
// Memory:  64 bytes for each node that sees the lamp or could.
// Threads: const after construction.   Errors: none.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "common/gi/intersection_field/lamp_lines.h"

namespace ninefold {

class LampPairs {
 public:
  static constexpr double kQuantum = 0x1p-24;
  static constexpr size_t kBytesPerNode = 64;

  struct Sums {
    std::array<int64_t, 3> seen{};
    int64_t all = 0;
  };
  static_assert(2 * sizeof(Sums) == kBytesPerNode);

  // `before`: of the same lamp in the scene of `then`, or null: it saves work alone.
  LampPairs(LampLines& now, const AreaLamp& lamp, const LampPairs* before, LampLines* then);

  // Null: no pair.
  const Sums* sumsOf(size_t instance, uint32_t node, bool isBack) const;
  uint64_t lines() const { return lines_; }  // that were looked at to make it
  size_t bytes() const;

 private:
  // Front and back of each node of an instance.
  using Sides = std::vector<Sums>;
  using Changed = std::vector<uint32_t>;  // instances

  bool isUsable(const LampScene& scene, const AreaLamp& lamp, const LampScene& then) const;
  Changed goOn(const LampPairs& before, const LampScene& scene, const LampScene& then);
  void add(const LampScene& scene, const LampLines::Pair& pair, int sign);
  Sides& own(const LampScene& scene, uint32_t instance);

  std::vector<std::shared_ptr<Sides>> sides_;  // by instance; null: no pair. Shared where they stay
  std::vector<bool> isKept_;                   // by instance: sums went on from those of before
  uint64_t lines_ = 0;
};

}  // namespace ninefold
