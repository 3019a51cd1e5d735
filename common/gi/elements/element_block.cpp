#include "common/gi/elements/element_block.h"

#include <algorithm>
#include <cmath>

#include "common/base/error.h"
#include "common/gi/elements/element_nodes.h"
#include "common/sampling/hash.h"
#include "common/scene/alpha_test.h"

namespace ninefold {
namespace {

constexpr uint32_t kMostCuts = 4096;
constexpr uint32_t kHoleRows = 4;

struct Corners {
  Vec3 p[3];  // in the scene

  float edge(int k) const { return glm::length(p[(k + 1) % 3] - p[k]); }
  float longest() const { return std::max({edge(0), edge(1), edge(2)}); }
  float shortest() const { return std::min({edge(0), edge(1), edge(2)}); }
  float area() const { return 0.5f * glm::length(glm::cross(p[1] - p[0], p[2] - p[0])); }
};

Corners cornersIn(const Mesh& mesh, const DMat3& linear, const Triangle& t) {
  const auto corner = [&](uint32_t vertex) { return Vec3(linear * DVec3(mesh.positions[vertex])); };
  return {{corner(t.x), corner(t.y), corner(t.z)}};
}

// A node before near ones are put together.
struct RawNode {
  Vec3 position{0}, normal{0};
  Metres nearest = std::numeric_limits<float>::infinity();  // to another one of its elements
  double area = 0;
};

class Making {
 public:
  Making(const Mesh& mesh, const DMat3& linear, Metres size, const Twins& twins)
      : mesh_(mesh), linear_(linear), size_(size), twins_(twins) {}

  void cut(std::vector<uint16_t>& cuts, std::vector<uint32_t>& firstPoint) {
    uint64_t points = 0;
    for (uint32_t k = 0; k < mesh_.triangles.size(); ++k) {
      const float pieces = std::ceil(cornersOf(mesh_.triangles[k]).longest() / size_);
      const auto n = static_cast<uint32_t>(std::clamp(pieces, 1.0f, float(kMostCuts)));
      const bool isTwin = twins_.find(k) != nullptr;
      cuts.push_back(static_cast<uint16_t>(isTwin ? 0 : n));
      firstPoint.push_back(static_cast<uint32_t>(points));
      if (!isTwin) points += TriangleElements::pointsOf(n);
      if (points > ElementBlock::kMostPoints)
        fail(
            "the elements of {}, a mesh of {} triangles, are too many: raise --element-size, or "
            "use "
            "another method",
            mesh_.name.empty() ? "something" : mesh_.name, mesh_.triangles.size());
    }
  }

  std::vector<uint32_t> name(const std::vector<uint16_t>& cuts) {
    SmoothCorners corners;
    std::vector<std::array<uint32_t, 3>> ends;
    for (size_t k = 0; k < cuts.size(); ++k)
      ends.push_back(cuts[k] > 0 ? endsOf(mesh_.triangles[k], corners) : std::array<uint32_t, 3>{});
    EdgePoints edges(static_cast<uint32_t>(corners.size()));
    std::vector<uint32_t> nodeOf;
    for (size_t k = 0; k < cuts.size(); ++k)
      if (cuts[k] > 0) namePoints(ends[k], cuts[k], edges, nodeOf);
    raw_.resize(edges.size());
    return nodeOf;
  }

  // Fills positions, normals, areas and connections of the nodes.
  void survey(const std::vector<uint16_t>& cuts, const std::vector<uint32_t>& firstPoint,
              const std::vector<uint32_t>& nodeOf, Connected& connected) {
    for (size_t k = 0; k < cuts.size(); ++k) {
      const Corners at = cornersOf(mesh_.triangles[k]);
      const uint32_t n = cuts[k];
      if (n == 0) continue;
      const float step = 1 / static_cast<float>(n);
      const double third = static_cast<double>(at.area()) / (3.0 * n * n);
      for (uint32_t j = 0; j <= n; ++j)
        for (uint32_t i = 0; i + j <= n; ++i) {
          RawNode& node = raw_[nodeOf[firstPoint[k] + TriangleElements::pointOf(i, j, n)]];
          const float u = step * static_cast<float>(i), v = step * static_cast<float>(j);
          node.position = at.p[0] + u * (at.p[1] - at.p[0]) + v * (at.p[2] - at.p[0]);
          node.normal = glm::cross(at.p[1] - at.p[0], at.p[2] - at.p[0]);
          node.nearest = std::min(node.nearest, step * at.shortest());
          node.area += third * elementsAround(i, j, n);
          const uint32_t name = nodeOf[firstPoint[k] + TriangleElements::pointOf(i, j, n)];
          connected.join(name, nodeOf[firstPoint[k]]);
        }
    }
  }

  // The final node of each raw one, their areas and middles.
  std::vector<uint32_t> merge(Connected& connected, std::vector<float>& areas,
                              std::vector<Vec3>& positions) {
    std::unordered_map<uint64_t, double> areaOfCell;
    for (uint32_t i = 0; i < raw_.size(); ++i)
      if (isFine(raw_[i])) areaOfCell[cellOf(raw_[i], 1 + connected.find(i))] += raw_[i].area;
    const double least = 0.25 * double{size_} * double{size_};
    std::unordered_map<uint64_t, uint32_t> nodes;
    std::vector<uint32_t> final(raw_.size());
    std::vector<double> sums;
    std::vector<DVec3> moments;
    for (uint32_t i = 0; i < raw_.size(); ++i) {
      const auto fresh = static_cast<uint32_t>(sums.size());
      final[i] = fresh;
      if (isFine(raw_[i])) {
        uint64_t cell = cellOf(raw_[i], 1 + connected.find(i));
        if (areaOfCell[cell] < least) cell = cellOf(raw_[i], 0);
        final[i] = nodes.try_emplace(cell, fresh).first->second;
      }
      if (final[i] == fresh) {
        sums.push_back(0), moments.emplace_back(0);
        positions.push_back(raw_[i].position);
      }
      sums[final[i]] += raw_[i].area, moments[final[i]] += raw_[i].area * DVec3(raw_[i].position);
    }
    areas.assign(sums.begin(), sums.end());
    for (size_t node = 0; node < sums.size(); ++node)
      if (sums[node] > 0) positions[node] = Vec3(moments[node] / sums[node]);
    return final;
  }

 private:
  Corners cornersOf(const Triangle& t) const { return cornersIn(mesh_, linear_, t); }

  std::array<uint32_t, 3> endsOf(const Triangle& t, SmoothCorners& corners) const {
    const Vec3 across = glm::cross(mesh_.positions[t.y] - mesh_.positions[t.x],
                                   mesh_.positions[t.z] - mesh_.positions[t.x]);
    const float length = glm::length(across);
    const Vec3 flat = length > 0 ? across / length : Vec3(0, 0, 1);
    std::array<uint32_t, 3> ends;
    for (int c = 0; c < 3; ++c) {
      const uint32_t vertex = t[c];
      ends[static_cast<size_t>(c)] = corners.nodeOf(
          mesh_.positions[vertex], mesh_.normals.empty() ? flat : mesh_.normals[vertex]);
    }
    return ends;
  }

  static void namePoints(const std::array<uint32_t, 3>& ends, uint32_t n, EdgePoints& edges,
                         std::vector<uint32_t>& nodeOf) {
    for (uint32_t j = 0; j <= n; ++j)
      for (uint32_t i = 0; i + j <= n; ++i) {
        const uint32_t k = n - i - j;
        nodeOf.push_back(j == 0   ? edges.nodeOf(ends[0], ends[1], i, n)
                         : i == 0 ? edges.nodeOf(ends[0], ends[2], j, n)
                         : k == 0 ? edges.nodeOf(ends[1], ends[2], j, n)
                                  : edges.add());
      }
  }

  bool isFine(const RawNode& node) const { return node.nearest < 0.5f * size_; }

  // Of the triangle's n^2 elements: one at its corners, three on its edges, six inside.
  static int elementsAround(uint32_t i, uint32_t j, uint32_t n) {
    const int edges = (i == 0) + (j == 0) + (i + j == n);
    return edges == 0 ? 6 : edges == 1 ? 3 : 1;
  }

  uint64_t cellOf(const RawNode& node, uint32_t surface) const {
    const Vec3 cell = glm::floor(node.position / size_);
    const Vec3 a = glm::abs(node.normal);
    const int axis = a.x >= a.y ? (a.x >= a.z ? 0 : 2) : (a.y >= a.z ? 1 : 2);
    const uint64_t side = static_cast<uint64_t>(2 * axis + (node.normal[axis] < 0));
    const auto word = [](float x) { return static_cast<uint64_t>(static_cast<int64_t>(x)); };
    return hashWords(word(cell.x), word(cell.y), word(cell.z), uint64_t{surface} << 3 | side);
  }

  const Mesh& mesh_;
  const DMat3& linear_;
  const Metres size_;
  const Twins& twins_;
  std::vector<RawNode> raw_;
};

}  // namespace

ElementBlock::ElementBlock(const Scene& scene, const Mesh& mesh, const DMat3& linear, Metres size)
    : mesh_(&mesh), linear_(linear), size_(size), twins_(mesh) {
  Making making(mesh, linear, size, twins_);
  making.cut(cuts_, firstPoint_);
  uint32_t elements = 0;
  for (size_t k = 0; k < cuts_.size(); ++k) {
    firstElement_.push_back(elements);
    elements += uint32_t{cuts_[k]} * cuts_[k];
    triangleAreas_.push_back(cornersIn(mesh, linear, mesh.triangles[k]).area());
  }
  nodeOf_ = making.name(cuts_);
  const uint32_t most = nodeOf_.empty() ? 0 : *std::max_element(nodeOf_.begin(), nodeOf_.end());
  Connected connected(size_t{most} + 1);
  making.survey(cuts_, firstPoint_, nodeOf_, connected);
  const std::vector<uint32_t> merged = making.merge(connected, areas_, positions_);
  for (uint32_t& node : nodeOf_) node = merged[node];
  const Material& material = scene.materials[static_cast<size_t>(mesh.material)];
  if (material.alphaMode == AlphaMode::mask) leaveOutHoles(scene, mesh);
}

// Areas are those on which photons can land: the middles of kHoleRows^2 alike parts of each element
// tell.
void ElementBlock::leaveOutHoles(const Scene& scene, const Mesh& mesh) {
  std::vector<double> areas(areas_.size(), 0);
  forEachElement([&](const Element& e) {
    const double share = double{e.area} / (kHoleRows * kHoleRows);
    forEachMiddle(kHoleRows, [&](const std::array<float, 3>& weights) {
      const Vec2 at = e.at(weights);
      if (isOpenAt(scene, mesh, e.triangle, at.x, at.y)) return;
      for (size_t c = 0; c < 3; ++c) areas[e.nodes[c]] += double{weights[c]} * share;
    });
  });
  areas_.assign(areas.begin(), areas.end());
}

ElementPlace ElementBlock::at(uint32_t triangle, float u, float v) const {
  const Twins::Twin* twin = twins_.find(triangle);
  if (twin == nullptr) return within(triangle, u, v);
  std::array<float, 3> weights{};
  weights[twin->corners[0]] = std::max(1 - u - v, 0.0f), weights[twin->corners[1]] = u;
  weights[twin->corners[2]] = v;
  ElementPlace there = within(twin->triangle, weights[1], weights[2]);
  there.isTurned = twin->isTurned;
  return there;
}

ElementPlace ElementBlock::within(uint32_t triangle, float u, float v) const {
  const TriangleElements elements = elementsOf(triangle);
  const TriangleElements::Place place = elements.at(u, v);
  return {place.nodes, place.weights, triangle,
          firstElement_[triangle] + elements.numberOf(place.cell)};
}

}  // namespace ninefold
