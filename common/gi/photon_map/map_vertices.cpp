#include "common/gi/photon_map/map_vertices.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace ninefold {
namespace {

constexpr float kAgreeingShading = 0.866f, kAgreeingFronts = 0.5f;  // cosines of 30, 60 degrees
constexpr uint32_t kNone = ~0u;

Vec3 unitOr(const Vec3& v, const Vec3& fallback) {
  const float length = glm::length(v);
  return length > 0 && std::isfinite(length) ? v / length : fallback;
}

Vec3 frontOf(const Mesh& mesh, const Triangle& t) {
  const DVec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
  const DVec3 n = glm::cross(b - a, c - a);
  const double length = glm::length(n);
  return length > 0 ? Vec3(n / length) : Vec3(0);
}

// A number for each vertex of the mesh: the same for those in the same place.
std::vector<uint32_t> placesOf(const Mesh& mesh) {
  const auto& at = mesh.positions;
  const auto isBefore = [&](uint32_t i, uint32_t j) {
    const Vec3 &a = at[i], &b = at[j];
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
  };
  std::vector<uint32_t> order(at.size()), places(at.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), isBefore);
  uint32_t place = 0;
  for (size_t i = 0; i < order.size(); ++i) {
    if (i > 0 && isBefore(order[i - 1], order[i])) ++place;
    places[order[i]] = place;
  }
  return places;
}

// Inner vertices of a triangle.
uint32_t innerCount(uint32_t n) { return n < 3 ? 0 : (n - 1) * (n - 2) / 2; }

// The inner ones of all rows before i, 1 <= i < n - 1.
uint32_t innerBefore(uint32_t n, uint32_t i) { return (i - 1) * (n - 1) - i * (i - 1) / 2; }

}  // namespace

MeshVertices::MeshVertices(const Mesh& mesh, int levels) : n_(1u << levels) {
  findCorners(mesh);
  findEdges();
  count_ = static_cast<uint32_t>(corners_.size() + (n_ - 1) * edges_.size() +
                                 innerCount(n_) * triangles_.size());
}

void MeshVertices::findCorners(const Mesh& mesh) {
  struct Normals {
    Vec3 shading, front;
    uint32_t next;  // corner in the same place
  };
  const std::vector<uint32_t> places = placesOf(mesh);
  std::vector<uint32_t> firsts(mesh.positions.size(), kNone);
  std::vector<Normals> found;
  triangles_.resize(mesh.triangles.size());
  for (uint32_t t = 0; t < triangles_.size(); ++t) {
    const Vec3 front = frontOf(mesh, mesh.triangles[t]);
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t vertex = mesh.triangles[t][static_cast<int>(k)];
      const Vec3 shading = mesh.normals.empty() ? front : mesh.normals[vertex];
      uint32_t corner = firsts[places[vertex]];
      while (corner != kNone && !(glm::dot(found[corner].shading, shading) >= kAgreeingShading &&
                                  glm::dot(found[corner].front, front) >= kAgreeingFronts))
        corner = found[corner].next;
      if (corner == kNone) {
        corner = static_cast<uint32_t>(found.size());
        found.push_back({shading, front, firsts[places[vertex]]});
        corners_.push_back({t, k});
        firsts[places[vertex]] = corner;
      }
      triangles_[t].corner[k] = corner;
    }
  }
}

void MeshVertices::findEdges() {
  struct Side {
    uint32_t low, high, triangle, k;
    auto key() const { return std::pair(low, high); }
  };
  std::vector<Side> sides;
  sides.reserve(3 * triangles_.size());
  for (uint32_t t = 0; t < triangles_.size(); ++t)
    for (uint32_t k = 0; k < 3; ++k) {
      const auto [low, high] =
          std::minmax(triangles_[t].corner[k], triangles_[t].corner[(k + 1) % 3]);
      sides.push_back({low, high, t, k});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tuple(a.key(), a.triangle, a.k) < std::tuple(b.key(), b.triangle, b.k);
  });
  for (size_t i = 0; i < sides.size(); ++i) {
    const Side& side = sides[i];
    if (i == 0 || sides[i - 1].key() != side.key()) edges_.push_back({side.triangle, side.k});
    triangles_[side.triangle].edge[side.k] = static_cast<uint32_t>(edges_.size()) - 1;
  }
}

// Edges run from the corner with the lower number.
uint32_t MeshVertices::onEdge(uint32_t triangle, uint32_t k, uint32_t step) const {
  const Names& names = triangles_[triangle];
  if (names.corner[k] > names.corner[(k + 1) % 3]) step = n_ - step;
  return corners() + names.edge[k] * (n_ - 1) + step - 1;
}

uint32_t MeshVertices::at(uint32_t triangle, uint32_t i, uint32_t j) const {
  const uint32_t k = n_ - i - j;  // steps from the opposite side to the first corner
  if (k == n_) return triangles_[triangle].corner[0];
  if (i == n_) return triangles_[triangle].corner[1];
  if (j == n_) return triangles_[triangle].corner[2];
  if (j == 0) return onEdge(triangle, 0, i);
  if (k == 0) return onEdge(triangle, 1, j);
  if (i == 0) return onEdge(triangle, 2, k);
  return corners() + static_cast<uint32_t>(edges_.size()) * (n_ - 1) + triangle * innerCount(n_) +
         innerBefore(n_, i) + j - 1;
}

MeshVertices::Place MeshVertices::placeAt(uint32_t triangle, uint32_t i, uint32_t j) const {
  const float n = static_cast<float>(n_);
  return {triangle, triangles_[triangle].corner,
          Vec3(static_cast<float>(n_ - i - j), static_cast<float>(i), static_cast<float>(j)) / n};
}

MeshVertices::Place MeshVertices::placeOf(uint32_t vertex) const {
  const auto along = [&](uint32_t triangle, uint32_t k, uint32_t step) {
    if (k == 0) return placeAt(triangle, step, 0);
    return k == 1 ? placeAt(triangle, n_ - step, step) : placeAt(triangle, 0, n_ - step);
  };
  if (vertex < corners()) return along(corners_[vertex].triangle, corners_[vertex].k, 0);
  vertex -= corners();
  if (vertex < edges_.size() * (n_ - 1)) {
    const First& edge = edges_[vertex / (n_ - 1)];
    const uint32_t step = vertex % (n_ - 1) + 1;
    const auto& corner = triangles_[edge.triangle].corner;
    const bool turned = corner[edge.k] > corner[(edge.k + 1) % 3];
    return along(edge.triangle, edge.k, turned ? n_ - step : step);
  }
  vertex -= static_cast<uint32_t>(edges_.size()) * (n_ - 1);
  const uint32_t triangle = vertex / innerCount(n_), inner = vertex % innerCount(n_);
  uint32_t i = 1;
  while (i + 2 < n_ && innerBefore(n_, i + 1) <= inner) ++i;
  return placeAt(triangle, i, inner - innerBefore(n_, i) + 1);
}

MapVertices::MapVertices(const Transport& t)
    : t_(t), n_(1u << t.settings.mapSubdivision), meshes_(t.scene.meshes.size()) {
  for (uint32_t object = 0; object < t.scene.instances.size(); ++object) {
    const auto name = static_cast<size_t>(t.scene.instances[object].mesh);
    const Mesh& mesh = t.scene.meshes[name];
    if (meshes_[name] == nullptr)
      meshes_[name] = std::make_shared<const MeshVertices>(mesh, t.settings.mapSubdivision);
    const MeshVertices& vertices = *meshes_[name];
    first_.push_back(count_);
    count_ += vertices.count();
    std::vector<Vec3> normals(vertices.corners(), Vec3(0));
    for (uint32_t triangle = 0; triangle < mesh.triangles.size(); ++triangle)
      for (size_t k = 0; k < 3; ++k)
        normals[vertices.cornerOf(triangle, k)] += t.tracer.frontNormal(object, triangle);
    for (Vec3& n : normals) n = unitOr(n, Vec3(0, 1, 0));
    normals_.push_back(std::move(normals));
  }
}

MapVertices::Around MapVertices::around(uint32_t object, uint32_t triangle, float u, float v,
                                        bool back) const {
  const auto name = static_cast<size_t>(t_.scene.instances[object].mesh);
  const MeshVertices& mesh = *meshes_[name];
  const float x = u * static_cast<float>(n_), y = v * static_cast<float>(n_);
  const uint32_t i = std::min(static_cast<uint32_t>(x), n_ - 1);
  const uint32_t j = std::min(static_cast<uint32_t>(y), n_ - 1 - i);
  const float du = std::clamp(x - static_cast<float>(i), 0.0f, 1.0f);
  const float dv = std::clamp(y - static_cast<float>(j), 0.0f, 1.0f);
  // Half of the rhombus i, j, but in the last row, where there is no other half.
  const bool isUpper = du + dv > 1 && i + j + 2 <= n_;
  Around found;
  if (isUpper) {
    found.entry = {mesh.at(triangle, i + 1, j + 1), mesh.at(triangle, i, j + 1),
                   mesh.at(triangle, i + 1, j)};
    found.weight = {du + dv - 1, 1 - du, 1 - dv};
  } else {
    found.entry = {mesh.at(triangle, i, j), mesh.at(triangle, i + 1, j),
                   mesh.at(triangle, i, j + 1)};
    const float sum = std::max(du + dv, 1.0f);
    found.weight = {std::max(1 - du - dv, 0.0f), du / sum, dv / sum};
  }
  for (uint32_t& entry : found.entry) entry += first_[object] + (back ? count_ : 0);
  return found;
}

Receiver MapVertices::receiver(uint32_t entry) const {
  const bool back = entry >= count_;
  const uint32_t vertex = back ? entry - count_ : entry;
  const auto object = static_cast<uint32_t>(std::upper_bound(first_.begin(), first_.end(), vertex) -
                                            first_.begin() - 1);
  const auto name = static_cast<size_t>(t_.scene.instances[object].mesh);
  const MeshVertices::Place place = meshes_[name]->placeOf(vertex - first_[object]);
  const Tracer::Corners at = t_.tracer.corners(object, place.triangle);
  Vec3 n(0);
  for (int k = 0; k < 3; ++k)
    n += place.weights[k] * normals_[object][place.corner[static_cast<size_t>(k)]];
  n = unitOr(n, t_.tracer.frontNormal(object, place.triangle));
  Receiver r;
  r.position = place.weights.x * at.a + place.weights.y * at.b + place.weights.z * at.c;
  r.ng = r.ns = back ? -n : n;
  r.origin = r.position;
  r.pixel = entry;
  r.object = object, r.triangle = place.triangle;
  r.u = place.weights.y, r.v = place.weights.z;
  return r;
}

}  // namespace ninefold
