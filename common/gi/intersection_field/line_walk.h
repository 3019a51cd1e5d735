// line_walk.h: photons go along lines.
//
//   at a matte surface   one of the three nodes of the element is chosen by its weight, one of the
//                        lines through that node by its measure; the photon goes on along it, to
//                        the side of the surface that it came to
//   where it arrives     the next hit on that line; what it leaves there is multiplied by
//                        pi A/(sum of mu) of the nodes, as all that comes by lines comes by those
//
// So light that is the same everywhere comes out the same, however unevenly lines pass the nodes.
//
// What stands on a node covers some of it, and a wall on it has two sides. So the line's place on
// the node must be seen from where the photon came to: one short ray tells. Of kTries lines the
// first one is taken.
//
// No ray is traced to find where light goes to, but where no line will do: none passes the node (it
// is much smaller than the lines lie apart), or all begin behind something.
//
// Source:  Ren et al. 2005, 5 (indirect irradiance).
// Proved:  tests/gi/intersection_field_test.cpp.
// Threads: const.   Owner: refers to its parts.   Errors: none.
#pragma once

#include "common/gi/elements/element_light.h"
#include "common/gi/intersection_field/node_lines.h"
#include "common/gi/light/light_path.h"

namespace ninefold {

// The lines through the nodes of all instances. Those of `before` are used again.
class SceneNodeLines {
 public:
  SceneNodeLines(const LineField& field, const Scene& scene, const SceneElements& elements,
                 const LineField* fieldBefore, const SceneElements* elementsBefore,
                 const SceneNodeLines* before);
  const NodeLines& of(size_t instance) const { return *lines_[instance]; }
  size_t bytes() const;

 private:
  std::vector<std::shared_ptr<const NodeLines>> lines_;
};

struct LineWalk {
  const Tracer& tracer;
  const LineField& field;
  const SceneElements& elements;
  const SceneNodeLines& lines;

  // The way on of a photon that came to p. Adds its rays to `rays`.
  WayOn leave(const ShadingPoint& p, Vec2 u, RayCounts& rays) const;
  // Factor on the flux that it leaves at p, where it came by a line.
  float gain(const ShadingPoint& p) const;

 private:
  static constexpr int kTries = 4;

  bool isSeen(const ShadingPoint& p, Vec3 place, Vec3 normal) const;
  WayOn along(const NodeLines::Start& start, bool isForward) const;
};

}  // namespace ninefold
