// node_parts.h: what stands on a surface divides its nodes into parts, whose light is their own.
//
//   side    of x, towards a corner of its element: 0 if x sees it (surface_sight.h), or sees
//           another corner that sees it; else what hides it
//   part    of a node, on one face of the surface: those places on its elements that have one side
//   A_part  sum over the middles of kRows^2 alike pieces of each element of w dA; what something
//           touches (surface_sight.h), or is a hole, has no area
//
// So light does not leak under a wall that stands on an element, and what a thing covers is no area
// of what is around it: inside of things are parts of their own, which no light reaches.
//
// Elements on which nothing stands are not divided. Those wholly on one side need no ray, the
// others up to three short ones for each place that is asked.
//
// Parts smaller than kLeast h^2 belong to the node's largest one: too few pieces tell their area,
// and they would get hardly a photon.
//
// It is that of the scene as it is now: what moves uncovers where it was, and covers where it goes,
// once it rests (still_scene.h).
// Hits of photons name triangles and places, so that they need not be traced again for that.
//
// Source:  made for this project.   Proved: tests/gi/node_parts_test.cpp.
// Fails:   Elements of triangles that are smaller than h/2 are never divided, and share their nodes
//          with others in their cell: what stands on a finely cut floor darkens it, and light leaks
//          under it. So does what standing.h and surface_sight.h miss.
// Memory:  a part 4 bytes, and its light (element_light.h).
// Threads: const after construction.   Errors: none.
#pragma once

#include <unordered_map>

#include "common/gi/elements/standing.h"
#include "common/gi/elements/surface_numbers.h"

namespace ninefold {

// Where light goes that falls onto a point, and comes from. Weights are >= 0, their sum is 1.
struct PartPlace {
  std::array<uint32_t, 3> parts;
  std::array<float, 3> weights;
};

class NodeParts {
 public:
  // `before`: of the same block in a scene that differs within the boxes `changed` alone, or null:
  // it saves work alone.
  NodeParts(const Tracer& tracer, uint32_t instance, const ElementBlock& block,
            const NodeParts* before, std::span<const Bounds> changed);
  // Not divided, whatever stands there.
  NodeParts(const Tracer& tracer, uint32_t instance, const ElementBlock& block);

  size_t size() const { return areas_.size(); }
  float area(uint32_t part) const { return areas_[part]; }  // [m^2]
  // `tracer`: of a scene that is the same around the instance.
  PartPlace at(const Tracer& tracer, const ElementBlock& block,
               const SurfaceNumbers::Surface& surface, float u, float v) const;

  // How far rays go beyond the instance's box.
  static Metres reach(Metres size) { return 0.1f * size; }

 private:
  using Sides = std::array<uint8_t, 3>;  // by corner
  // An element on which something stands, from one of its faces.
  struct Divided {
    std::vector<Sides> sides;     // of its middles
    bool isWhole = true;          // all alike
    std::array<Sides, 3> seen{};  // between its corners
  };
  struct Found {
    std::array<uint32_t, 3> parts{};
    bool isWhole = true;  // else its places have parts of their own
    std::array<Sides, 3> seen{};
  };
  class Making;

  // `face`: 2 n in front of node n, 2 n + 1 behind it.
  uint32_t partOf(uint32_t face, uint8_t side) const;

  std::vector<float> areas_;  // by part; the largest of a node's face has the face's number
  std::unordered_map<uint32_t, uint32_t> others_;  // other parts, by 16 (face of a node) + side
  std::unordered_map<uint32_t, Divided> divided_;  // by face of an element, likewise 2 e + isBack
  std::unordered_map<uint32_t, Found> found_;      // where places have not the largest parts alone
};

}  // namespace ninefold
