// shape_edit.h: a mesh's vertices replaced, piece by piece: a deformation.
//
//   piece k   the vertices from k kVertices on, kVertices of them or what is left
//
// Triangles, texture coordinates and colours stay. A mesh that was read with normals gets new ones
// with its positions; one without has none. Tangents of a deformed mesh come from its texture
// coordinates. Pieces that nobody named stay as they were read, and all instances of the mesh
// change alike.
//
//   SceneEdit edit;
//   edit.shapes = shapeEdits(mesh, positions, normals);   in the mesh's own coordinates [m]
//
// Proved:  tests/scene/shape_edit_test.cpp.   Threads: plain values, pure functions.
// Errors:  checkShapes throws Error that names mesh and vertex.
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/scene/scene.h"

namespace ninefold {

// Of all meshes that are deformed at once: a client's line must have room for a few such edits.
inline constexpr size_t kMaxShapeVertices = size_t{1} << 19;

struct ShapePiece {
  static constexpr uint32_t kVertices = 16384;
  uint32_t mesh = 0;  // index into Scene::meshes
  uint32_t piece = 0;
  auto operator<=>(const ShapePiece&) const = default;
};

struct ShapeVertices {
  std::vector<Vec3> positions;  // of the mesh [m]
  std::vector<Vec3> normals;    // empty, or one for each, unit
  bool operator==(const ShapeVertices&) const = default;
};

struct ShapeEdit {
  ShapePiece where;
  std::shared_ptr<const ShapeVertices> vertices;  // never null; edits share it
  bool operator==(const ShapeEdit& other) const {
    return where == other.where && (vertices == other.vertices || *vertices == *other.vertices);
  }
};

// A whole mesh. normals: empty, or as many as positions.
std::vector<ShapeEdit> shapeEdits(uint32_t mesh, std::span<const Vec3> positions,
                                  std::span<const Vec3> normals);
// A piece as it is in `scene`, which has it.
ShapeEdit editOfShape(const Scene& scene, ShapePiece where);

size_t verticesOf(const std::vector<ShapeEdit>& edits);
// Throws Error unless `scene` has such meshes and their pieces can be so.
void checkShapes(const Scene& scene, const std::vector<ShapeEdit>& edits);

// Gives meshes of `scene`, which are as they were read, their new shapes. `edits` ascend.
// `before`: an earlier state of the same scene, or null. A shape that is as it was there, or as it
// was read, is the same element: what was worked out about it holds.
void reshape(Scene& scene, const std::vector<ShapeEdit>& edits, const Scene* before);

}  // namespace ninefold
