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

#include "common/gi/elements/twins.h"
#include "common/scene/scene.h"

namespace ninefold {

// Where light goes that falls onto a point, and comes from. Weights are >= 0, their sum is 1.
struct ElementPlace {
  std::array<uint32_t, 3> nodes;
  std::array<float, 3> weights;
  bool isTurned = false;  // the elements' front is the triangle's back
};

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
  float area(uint32_t node) const { return areas_[node]; }  // [m^2]
  // u, v: barycentrics of the second and third corner.
  ElementPlace at(uint32_t triangle, float u, float v) const;

 private:
  ElementPlace within(uint32_t triangle, float u, float v) const;
  void leaveOutHoles(const Scene& scene, const Mesh& mesh);

  const Mesh* mesh_;
  DMat3 linear_;
  Metres size_;
  // Points of a triangle's grid: row j has those at v = j/n, u = i/n.
  std::vector<uint16_t> cuts_;        // n, by triangle; 0: it is a twin
  std::vector<uint32_t> firstPoint_;  // by triangle
  std::vector<uint32_t> nodeOf_;      // by point
  std::vector<float> areas_;          // by node
  Twins twins_;
};

}  // namespace ninefold
