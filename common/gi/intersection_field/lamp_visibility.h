// lamp_visibility.h: how much of a lamp each node of the mesh elements sees, by the field's lines.
//
//   V = sum mu L vis / sum mu L     over pairs (p, q): a line that passes the node at p and a lamp
//                                   at q, each in front of the other
//   vis                             1 if no hit lies between p and q; light that passes straight
//                                   on through blended surfaces is dimmed (straight_light.h)
//
// mu is the measure of lines, so that pairs have the density dmu = cos_p cos_q/d^2 dA_p dA_q: they
// count as much as they bring light, and H V tends to the true E. (As published all pairs count
// alike, which is wrong by cos_p cos_q/d^2 and by the grid's density, however fine it is.)
//
// What hides q at less than kClose of an element's side before p covers p: a picture on a wall, a
// cupboard on a floor. Nobody sees such a p, and its pairs are left out, as elements would spread
// its dark over what is around.
//
// The lines are those of the lamp's local field: no ray is traced, and lines that miss the lamp are
// not looked at. A pair counts for the element's three nodes by their weights. Nodes with fewer
// than kFewest pairs know nothing.
//
//   E(x) = sum over lamps of H V       V from the three nodes at x, both sums apart
//
// where the nodes know nothing, a shadow ray to one of the lamp's disks takes the place of V.
//
// Source:  Ren et al. 2005, 5 (VRM).   Proved: tests/gi/lamp_visibility_test.cpp.
// Memory:  32 bytes for each lamp and node that sees it or could.
// Threads: const after construction.   Owner: refers to its arguments.   Errors: none.
#pragma once

#include "common/base/counters.h"
#include "common/gi/elements/element_light.h"
#include "common/gi/eye/receiver_samples.h"
#include "common/gi/intersection_field/area_lamps.h"
#include "common/gi/intersection_field/line_field.h"

namespace ninefold {

class LampVisibility {
 public:
  static constexpr float kFewest = 4;
  static constexpr float kClose = 0.125f;

  LampVisibility(const Transport& transport, const LineField& field, const SceneElements& elements);

  // Adds the light straight from area lamps. pathVertices as in layered_method.h.
  void gather(const ReceiverSamples& samples, int pathVertices, Receivers& receivers,
              RayCounts& rays) const;

 private:
  // What pairs bring to one side of a node.
  struct Pairs {
    Vec3 seen{0};  // sum mu L vis, over the mean mu and the brightest L
    float all = 0;
  };
  // Front and back of each node of an instance; empty: no pair.
  using Sides = std::vector<Pairs>;

  void addPairs(size_t lamp, const GridLine& line, const std::vector<LineHit>& hits, size_t at,
                bool isForward);
  void add(size_t lamp, const LineHit& hit, const GridLine& line, Vec3 way, Vec3 seen,
           float weight);
  Vec3 passed(const LineHit& hit, const GridLine& line, Vec3 way) const;
  Irradiance traced(const std::vector<Irradiance>& shares, const AreaLamp& lamp,
                    const Receivers& receivers, size_t i, float u, RayCounts& rays) const;
  Pairs at(size_t lamp, const SurfaceNumbers::Surface& surface, float u, float v) const;

  const Transport& t_;
  const LineField& field_;
  const SceneElements& elements_;
  const std::vector<AreaLamp> lamps_;
  double meanMeasure_;                     // of a line [m^2 sr]
  std::vector<std::vector<Sides>> pairs_;  // [lamp][instance]
};

}  // namespace ninefold
