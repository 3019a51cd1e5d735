// element_block.h: the mesh elements of one instance, and the nodes at their corners.
//
//   triangle   cut into n^2 alike elements; n = ceil(longest edge / h), edges in the scene
//   node       one of the corners. Elements share those at which the surface is smooth: corners of
//              triangles in one place whose normals agree (kSmooth). So light goes on across smooth
//              surfaces and ends at edges.
//   fine mesh  Nodes nearer to each other than h/2 are one if they lie in one cell of side h, on
//              one connected smooth surface, and face alike. What has less than h^2/4 there (slats,
//              leaves, books) is one with its like in the cell: alone it would get hardly a photon.
//   area       of a node: a third of each element around it [m^2], without holes. Holes are masked
//              texels, looked for at 16 points of each element.
//   twin       A triangle that is there twice, either way round: a ray meets one of the two. The
//              later one has no elements, and its light is the first one's.
//
// What else is in the scene makes no difference here: node_parts.h.
//
// A point of an element stands for its three nodes in proportion to its barycentrics w. A photon
// leaves w Phi at each, and E at a point is sum w Phi_node / area_node. So no light is lost, and a
// constant E comes out constant in the mean.
//
// Units:   metres of the scene.   Source: Dmitriev et al. 2002, 6 (mesh elements); linear ones with
//          lumped areas are made for this project.
// Proved:  tests/gi/element_test.cpp.
// Fails:   light is blurred over h. Triangles of another n next to each other share the ends of
//          their edge alone.
// Threads: const after construction.   Errors: throws Error if there are too many elements.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/gi/elements/triangle_elements.h"
#include "common/gi/elements/twins.h"
#include "common/scene/scene.h"

namespace ninefold {

// Where light goes that falls onto a point, and comes from. Weights are >= 0, their sum is 1.
struct ElementPlace {
  std::array<uint32_t, 3> nodes;
  std::array<float, 3> weights;
  uint32_t triangle = 0;  // that the element is cut from: of twins, the first
  uint32_t element = 0;   // its number among all of the block
  bool isTurned = false;  // the elements' front is the triangle's back
};

struct Element {
  uint32_t number, triangle;
  std::array<uint32_t, 3> nodes;
  std::array<Vec2, 3> corners;  // barycentrics in the triangle, in the order of the nodes
  float area;                   // holes included [m^2]

  Vec2 at(const std::array<float, 3>& weights) const {
    return weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
  }
};

// visit(weights) for the middles of rows^2 alike parts of an element.
template <typename Visit>
void forEachMiddle(uint32_t rows, const Visit& visit) {
  const float step = 1 / static_cast<float>(rows);
  for (uint32_t j = 0; j < rows; ++j)
    for (uint32_t i = 0; i < 2 * (rows - j) - 1; ++i) {
      const float third = i % 2 == 0 ? 1 / 3.0f : 2 / 3.0f;
      const float u = step * (static_cast<float>(i / 2) + third);
      const float v = step * (static_cast<float>(j) + third);
      visit(std::array<float, 3>{1 - u - v, u, v});
    }
}

class ElementBlock {
 public:
  // Of all blocks of a scene. 48 bytes of light a node, 4 bytes a point of a triangle's grid.
  static constexpr size_t kMostNodes = size_t{1} << 22, kMostPoints = size_t{1} << 24;

  // `linear`: of the instance's toWorld. Where it stands makes no difference.
  ElementBlock(const Scene& scene, const Mesh& mesh, const DMat3& linear, Metres size);

  // A block is a pure function of these, as edits change no mask.
  bool isOf(const Mesh& mesh, const DMat3& linear, Metres size) const {
    return mesh_ == &mesh && linear_ == linear && size_ == size;
  }
  size_t nodes() const { return areas_.size(); }
  size_t points() const { return nodeOf_.size(); }
  Metres size() const { return size_; }
  float area(uint32_t node) const { return areas_[node]; }  // [m^2]
  // Where it is, in the scene's axes, from the instance's origin. Of merged ones, the middle.
  Vec3 position(uint32_t node) const { return positions_[node]; }
  // u, v: barycentrics of the second and third corner.
  ElementPlace at(uint32_t triangle, float u, float v) const;
  size_t triangles() const { return cuts_.size(); }
  uint32_t cuts(uint32_t triangle) const { return cuts_[triangle]; }
  // Of a triangle that is no later twin.
  TriangleElements elementsOf(uint32_t triangle) const {
    return {cuts_[triangle], nodeOf_.data() + firstPoint_[triangle]};
  }
  template <typename Visit>
  void forEachElement(uint32_t triangle, const Visit& visit) const;  // visit(element)
  template <typename Visit>
  void forEachElement(const Visit& visit) const {  // by rising numbers
    for (uint32_t k = 0; k < cuts_.size(); ++k) forEachElement(k, visit);
  }

 private:
  ElementPlace within(uint32_t triangle, float u, float v) const;
  void leaveOutHoles(const Scene& scene, const Mesh& mesh);

  const Mesh* mesh_;
  DMat3 linear_;
  Metres size_;
  // Points and elements of each triangle: triangle_elements.h.
  std::vector<uint16_t> cuts_;          // n, by triangle; 0: it is a twin
  std::vector<uint32_t> firstPoint_;    // by triangle
  std::vector<uint32_t> firstElement_;  // by triangle
  std::vector<float> triangleAreas_;    // likewise [m^2]
  std::vector<uint32_t> nodeOf_;        // by point
  std::vector<float> areas_;            // by node
  std::vector<Vec3> positions_;         // likewise
  Twins twins_;
};

template <typename Visit>
void ElementBlock::forEachElement(uint32_t triangle, const Visit& visit) const {
  const TriangleElements elements = elementsOf(triangle);
  const uint32_t n = elements.n;
  const float step = 1 / static_cast<float>(n);
  uint32_t number = firstElement_[triangle];
  for (uint32_t j = 0; j < n; ++j)
    for (uint32_t c = 0; c < 2 * (n - j) - 1; ++c) {
      const TriangleElements::Cell cell{c / 2, j, c % 2 == 1};
      const Vec2 low = step * Vec2(cell.i, cell.j), high = step * Vec2(cell.i + 1, cell.j + 1);
      const Vec2 right(high.x, low.y), above(low.x, high.y);
      visit(Element{number++, triangle, elements.nodesOf(cell),
                    cell.isUpper ? std::array<Vec2, 3>{high, above, right}
                                 : std::array<Vec2, 3>{low, right, above},
                    step * step * triangleAreas_[triangle]});
    }
}

}  // namespace ninefold
