#include "common/scene/mesh_cleanup.h"

#include "common/base/error.h"
#include "common/math/rounding.h"

namespace ninefold {
namespace {

bool isFiniteVector(const Vec2& v) { return std::isfinite(v.x) && std::isfinite(v.y); }
bool isFiniteVector(const Vec3& v) { return isFinite(v); }
bool isFiniteVector(const Vec4& v) { return isFinite(Vec3(v)) && std::isfinite(v.w); }

template <typename V>
void checkFinite(const std::vector<V>& values, const std::string& what, const char* name) {
  for (size_t i = 0; i < values.size(); ++i)
    if (!isFiniteVector(values[i]))
      fail("{}: {} {} is not a finite number: export the scene again", what, name, i);
}

DVec3 twiceArea(const Mesh& mesh, const Triangle& t) {
  return exactNormal(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]);
}

size_t dropFlatTriangles(Mesh& mesh) {
  return std::erase_if(mesh.triangles, [&](const Triangle& t) {
    const double length = glm::length(twiceArea(mesh, t));
    return !(length > 0) || !std::isfinite(length);
  });
}

// Area-weighted mean of the faces around each vertex.
std::vector<DVec3> geometricNormals(const Mesh& mesh) {
  std::vector<DVec3> sums(mesh.positions.size(), DVec3(0));
  for (const Triangle& t : mesh.triangles) {
    const DVec3 n = twiceArea(mesh, t);
    for (int corner = 0; corner < 3; ++corner) sums[t[corner]] += n;
  }
  return sums;
}

bool makeUnit(Vec3& v) {
  const double length = glm::length(DVec3(v));
  if (!(length > 1e-30)) return false;
  v = Vec3(DVec3(v) / length);
  return true;
}

void cleanNormals(Mesh& mesh) {
  std::vector<DVec3> geometric;
  for (size_t i = 0; i < mesh.normals.size(); ++i) {
    if (makeUnit(mesh.normals[i])) continue;
    if (geometric.empty()) geometric = geometricNormals(mesh);
    const double length = glm::length(geometric[i]);
    mesh.normals[i] = length > 0 ? Vec3(geometric[i] / length) : Vec3(0, 1, 0);
  }
}

void cleanTangents(Mesh& mesh) {
  for (Vec4& t : mesh.tangents) {
    Vec3 direction(t);
    if (!makeUnit(direction) || mesh.normals.empty()) {
      mesh.tangents.clear();
      return;
    }
    t = Vec4(direction, t.w < 0 ? -1.0f : 1.0f);
  }
}

}  // namespace

std::vector<uint32_t> compactVertices(std::vector<Triangle>& triangles) {
  std::vector<uint32_t> used;
  used.reserve(3 * triangles.size());
  for (const Triangle& t : triangles) used.insert(used.end(), {t.x, t.y, t.z});
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  const bool unchanged = used.empty() || used.back() + size_t{1} == used.size();
  if (unchanged) return used;
  for (Triangle& t : triangles)
    for (int corner = 0; corner < 3; ++corner)
      t[corner] = static_cast<uint32_t>(std::lower_bound(used.begin(), used.end(), t[corner]) -
                                        used.begin());
  return used;
}

size_t cleanMesh(Mesh& mesh, const std::string& what, std::vector<uint32_t>* keptVertices) {
  checkFinite(mesh.positions, what, "position");
  checkFinite(mesh.normals, what, "normal");
  checkFinite(mesh.uv0, what, "texture coordinate");
  checkFinite(mesh.uv1, what, "texture coordinate");
  checkFinite(mesh.tangents, what, "tangent");
  checkFinite(mesh.colors, what, "colour");
  const size_t dropped = dropFlatTriangles(mesh);
  const std::vector<uint32_t> kept = compactVertices(mesh.triangles);
  keepOnly(mesh.positions, kept);
  keepOnly(mesh.normals, kept);
  keepOnly(mesh.uv0, kept);
  keepOnly(mesh.uv1, kept);
  keepOnly(mesh.tangents, kept);
  keepOnly(mesh.colors, kept);
  for (Vec4& color : mesh.colors) color = glm::clamp(color, 0.0f, 1.0f);
  cleanNormals(mesh);
  cleanTangents(mesh);
  if (keptVertices != nullptr) *keptVertices = kept;
  return dropped;
}

}  // namespace ninefold
