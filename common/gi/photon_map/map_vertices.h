// map_vertices.h: the vertices of the scene's meshes, each triangle cut into n x n, n = 2^levels:
// where they are, and which lie around a point.
//
//   a level cuts a triangle into four, at the middles of its edges
//   vertex (i, j) of a triangle   a + i/n (b - a) + j/n (c - a),   i, j >= 0, i + j <= n
//
// A corner is where triangles of a mesh meet in a point with agreeing normals: shading normals
// within 30 degrees and fronts within 60 of those of its first triangle. So light is shared across
// smooth surfaces, and never across an edge. Two corners make an edge, and the vertices on it are
// shared, too. A mesh has
//
//   corners + (n - 1) edges + (n - 1)(n - 2)/2 triangles       vertices
//
// numbered in this order, one instance after the other. A vertex's normal is the mean of the fronts
// that meet in it, interpolated along edges and in triangles. Numbers do not depend on where
// instances are, so that an edit of one leaves the vertices of all others as they are. Meshes
// share nothing: where two touch each has vertices of its own.
//
// Each vertex has two sides, of which each has light of its own: side s of vertex k is entry
// k + s count().
//
// Source:  Jozwowski 2002, 4.4 (corners; "vertices" of a uniformly subdivided mesh).
// Proved:  tests/gi/map_vertices_test.cpp (counts of known bodies, positions, weights).
// Fails:   where an edge of one triangle is met by two of another, no vertex is shared.
// Memory:  40 bytes a triangle and corner, whatever n.
// Threads: const after construction.   Errors: none; too many of them: settings_check.h.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "common/gi/eye/receivers.h"
#include "common/gi/light/transport.h"

namespace ninefold {

// Of one mesh, in the mesh's own coordinates.
class MeshVertices {
 public:
  MeshVertices(const Mesh& mesh, int levels);

  uint32_t corners() const { return static_cast<uint32_t>(corners_.size()); }
  uint32_t count() const { return count_; }
  // Corner k of a triangle, k < 3.
  uint32_t cornerOf(uint32_t triangle, size_t k) const { return triangles_[triangle].corner[k]; }
  // Vertex (i, j) of a triangle.
  uint32_t at(uint32_t triangle, uint32_t i, uint32_t j) const;

  // Where a vertex lies: weights of the three corners of one of its triangles, and their names.
  struct Place {
    uint32_t triangle = 0;
    std::array<uint32_t, 3> corner{};
    Vec3 weights{0};
  };
  Place placeOf(uint32_t vertex) const;

 private:
  // Edge k runs from corner k to the next.
  struct Names {
    std::array<uint32_t, 3> corner{}, edge{};
  };
  // The first triangle that has it, and its place there.
  struct First {
    uint32_t triangle = 0, k = 0;
  };
  void findCorners(const Mesh& mesh);
  void findEdges();
  uint32_t onEdge(uint32_t triangle, uint32_t k, uint32_t step) const;
  Place placeAt(uint32_t triangle, uint32_t i, uint32_t j) const;

  uint32_t n_;
  std::vector<Names> triangles_;
  std::vector<First> corners_, edges_;
  uint32_t count_ = 0;
};

class MapVertices {
 public:
  explicit MapVertices(const Transport& transport);

  uint32_t count() const { return count_; }
  uint32_t entries() const { return 2 * count_; }

  // The entries around a point of a triangle, and their weights, whose sum is 1.
  struct Around {
    std::array<uint32_t, 3> entry{};
    std::array<float, 3> weight{};
  };
  Around around(uint32_t object, uint32_t triangle, float u, float v, bool back) const;

  // Entry as what gathers light; named by itself.
  Receiver receiver(uint32_t entry) const;

 private:
  const Transport& t_;
  uint32_t n_, count_ = 0;
  std::vector<std::shared_ptr<const MeshVertices>> meshes_;  // by mesh
  std::vector<uint32_t> first_;                              // vertex of each instance
  std::vector<std::vector<Vec3>> normals_;                   // of each instance's corners, unit
};

}  // namespace ninefold
