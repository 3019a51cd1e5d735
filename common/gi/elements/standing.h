// standing.h: on which elements of a triangle something may stand or lie.
//
//   rows    rays just over the surface along each edge of the triangle, h/4 from each other: what
//           they meet stands on the elements there
//   looks   short rays away from the surface, up to four of each element: what they meet lies on it
//
// Source:  made for this project.   Proved: tests/gi/node_parts_test.cpp.
// Fails:   misses what is narrower than h/4 either way.
// Threads: pure function.   Errors: none.
#pragma once

#include <initializer_list>
#include <span>
#include <vector>

#include "common/gi/elements/element_block.h"
#include "common/gi/elements/surface_sight.h"

namespace ninefold {

inline bool meets(const Bounds& a, const Bounds& b) {
  return glm::all(glm::lessThanEqual(a.low, b.high)) && glm::all(glm::lessThanEqual(b.low, a.high));
}

// Where a scene may differ from another one.
struct SceneChanges {
  bool areAllOver = true;
  std::span<const Bounds> boxes;  // else within these

  // `reach`: beyond the box of the points.
  bool areNear(std::initializer_list<Vec3> points, Metres reach) const;
  // Any element of a triangle.
  bool areNear(const Tracer& tracer, uint32_t instance, const ElementBlock& block,
               uint32_t triangle) const;
  // An element, whose corners have their nodes elsewhere if those are merged.
  bool areNear(const Tracer& tracer, uint32_t instance, const ElementBlock& block,
               const Element& e) const;
};

// By element of the triangle and face, front first. Only where there are changes.
std::vector<bool> standingOn(const Tracer& tracer, uint32_t instance, const ElementBlock& block,
                             uint32_t triangle, const SceneChanges& changes);

// Pieces of an element along its side, `most` for one of size h.
uint32_t piecesAlong(const Element& e, Metres size, uint32_t most);

}  // namespace ninefold
