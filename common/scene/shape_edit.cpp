#include "common/scene/shape_edit.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "common/base/error.h"
#include "common/sampling/hash.h"

namespace ninefold {
namespace {

constexpr float kFarthest = 1e9f;  // of a vertex from its mesh's origin [m]

std::span<const Vec3> pieceOf(std::span<const Vec3> all, uint32_t piece) {
  const size_t first = size_t{piece} * ShapePiece::kVertices;
  if (first >= all.size()) return {};
  return all.subspan(first, std::min<size_t>(ShapePiece::kVertices, all.size() - first));
}

std::vector<Vec3> copyOf(std::span<const Vec3> values) { return {values.begin(), values.end()}; }

ShapeEdit cut(ShapePiece where, std::span<const Vec3> positions, std::span<const Vec3> normals) {
  return {where,
          std::make_shared<const ShapeVertices>(ShapeVertices{
              copyOf(pieceOf(positions, where.piece)), copyOf(pieceOf(normals, where.piece))})};
}

uint64_t numberOf(const ShapeVertices& shape) {
  uint64_t number = 0;
  for (const auto* list : {&shape.positions, &shape.normals})
    for (const Vec3& v : *list) {
      const auto bits = [&](int i) { return uint64_t{std::bit_cast<uint32_t>(v[i])}; };
      number = hashWords(number, bits(0) << 32 | bits(1), bits(2));
    }
  return number;
}

void replace(std::vector<Vec3>& all, uint32_t piece, const std::vector<Vec3>& by) {
  std::ranges::copy(by, all.begin() + std::ptrdiff_t{piece} * ShapePiece::kVertices);
}

// The mesh with another shape. Tangents as read would not lie along its surface.
Mesh reshaped(const Mesh& asRead, ShapeVertices shape) {
  Mesh mesh = asRead;
  mesh.shape = numberOf(shape);
  mesh.positions = std::move(shape.positions), mesh.normals = std::move(shape.normals);
  mesh.tangents.clear();
  return mesh;
}

// To the last bit: -0 is another number than 0.
bool isSame(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
}

void checkShape(const Scene& scene, const ShapeEdit& edit) {
  const auto [index, piece] = edit.where;
  if (index >= scene.meshes.size()) fail("edit: mesh {} does not exist", index);
  const Mesh& mesh = scene.meshes[index];
  const auto& [positions, normals] = *edit.vertices;
  const size_t wanted = pieceOf(mesh.positions, piece).size();
  if (wanted == 0 || positions.size() != wanted)
    fail("edit: piece {} of mesh {} '{}' has {} vertices, its new shape has {}", piece, index,
         mesh.name, wanted, positions.size());
  if (normals.size() != (mesh.normals.empty() ? 0 : wanted))
    fail("edit: mesh {} '{}' was read {} normals, its new shape has {} for {} vertices", index,
         mesh.name, mesh.normals.empty() ? "without" : "with", normals.size(), wanted);
  for (size_t i = 0; i < wanted; ++i) {
    const size_t vertex = size_t{piece} * ShapePiece::kVertices + i;
    if (!isFinite(positions[i]) || maxComponent(glm::abs(positions[i])) > kFarthest)
      fail("edit: vertex {} of mesh {} '{}' is not finite, or too far away", vertex, index,
           mesh.name);
    if (!normals.empty() && !(std::abs(glm::length(normals[i]) - 1) < 1e-3f))
      fail("edit: the normal of vertex {} of mesh {} '{}' is not of length 1", vertex, index,
           mesh.name);
  }
}

bool hasShape(const Mesh& mesh, const ShapeVertices& shape) {
  return isSame(mesh.positions, shape.positions) && isSame(mesh.normals, shape.normals);
}

}  // namespace

std::vector<ShapeEdit> shapeEdits(uint32_t mesh, std::span<const Vec3> positions,
                                  std::span<const Vec3> normals) {
  std::vector<ShapeEdit> edits;
  for (uint32_t piece = 0; size_t{piece} * ShapePiece::kVertices < positions.size(); ++piece)
    edits.push_back(cut({mesh, piece}, positions, normals));
  return edits;
}

ShapeEdit editOfShape(const Scene& scene, ShapePiece where) {
  const Mesh& mesh = scene.meshes[where.mesh];
  return cut(where, mesh.positions, mesh.normals);
}

size_t verticesOf(const std::vector<ShapeEdit>& edits) {
  size_t sum = 0;
  for (const ShapeEdit& edit : edits) sum += edit.vertices->positions.size();
  return sum;
}

void checkShapes(const Scene& scene, const std::vector<ShapeEdit>& edits) {
  if (verticesOf(edits) > kMaxShapeVertices)
    fail("edit: meshes of {} vertices change their shapes, at most {} can: deform simpler ones",
         verticesOf(edits), kMaxShapeVertices);
  for (const ShapeEdit& edit : edits) checkShape(scene, edit);
}

void reshape(Scene& scene, const std::vector<ShapeEdit>& edits, const Scene* before) {
  for (size_t i = 0; i < edits.size();) {
    const uint32_t index = edits[i].where.mesh;
    const Mesh& asRead = *scene.meshes.share(index);
    ShapeVertices shape{asRead.positions, asRead.normals};
    for (; i < edits.size() && edits[i].where.mesh == index; ++i) {
      replace(shape.positions, edits[i].where.piece, edits[i].vertices->positions);
      replace(shape.normals, edits[i].where.piece, edits[i].vertices->normals);
    }
    if (hasShape(asRead, shape)) continue;
    if (before != nullptr && hasShape(before->meshes[index], shape))
      scene.meshes.set(index, before->meshes.share(index));
    else
      scene.meshes.set(index, std::make_shared<Mesh>(reshaped(asRead, std::move(shape))));
  }
}

}  // namespace ninefold
