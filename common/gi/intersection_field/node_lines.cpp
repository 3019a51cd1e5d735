#include "common/gi/intersection_field/node_lines.h"

#include <algorithm>

#include "common/math/units.h"
#include "common/sampling/sampler.h"
#include "common/scene/alpha_test.h"
#include "common/scene/world.h"

namespace ninefold {
namespace {

// A random number of a line's hit: the same wherever it is asked.
float numberOf(uint32_t line, uint32_t run, uint64_t use) {
  return unitFloat(static_cast<uint32_t>(hashWords(line, run, use) >> 32));
}

uint32_t nodeAt(const ElementPlace& place, float u) {
  if (u < place.weights[0]) return place.nodes[0];
  return u < place.weights[0] + place.weights[1] ? place.nodes[1] : place.nodes[2];
}

// Of how many lines of a run one is kept.
uint32_t strideOf(uint64_t hits, size_t nodes) {
  const uint64_t wanted = NodeLines::kEach * std::max<uint64_t>(nodes, 1);
  return static_cast<uint32_t>(std::max<uint64_t>(hits / wanted, 1));
}

}  // namespace

NodeLines::NodeLines(const LineField& field, const Scene& scene, uint32_t instance,
                     const ElementBlock& block)
    : instance_(instance) {
  const LineGrid& grid = field.grid();
  const LocalField& local = field.local(instance);
  const Mesh& mesh = scene.meshes[static_cast<size_t>(scene.instances[instance].mesh)];
  const bool hasHoles =
      scene.materials[static_cast<size_t>(mesh.material)].alphaMode == AlphaMode::mask;
  const DMat4& toWorld = scene.instances[instance].toWorld;
  std::vector<Vec3> vertices;
  for (const Vec3& p : mesh.positions) vertices.push_back(worldPoint(toWorld, p));
  const uint32_t stride = strideOf(local.hits(), block.nodes());

  measures_.assign(block.nodes(), 0);
  std::vector<Entry> found;
  std::vector<uint32_t> nodes;
  local.forEachRun([&](GridLine line, uint32_t r) {
    const LineRun& run = local.runs()[r];
    const Triangle& t = mesh.triangles[run.triangle];
    line.m = run.first;
    const uint32_t number = grid.numberOf(line);
    const auto skip = static_cast<uint32_t>(static_cast<float>(stride) * numberOf(number, r, 1));
    for (uint32_t n = skip; n < run.count; n += stride) {
      line.m = static_cast<int>(run.first + n);
      const Vec2 at = barycentricsOf(vertices[t.x], vertices[t.y], vertices[t.z],
                                     grid.pointAt(line, run.at(line.m)));
      if (hasHoles && isOpenAt(scene, mesh, run.triangle, at.x, at.y)) continue;
      found.push_back({number + n, r});
      const ElementPlace place = block.at(run.triangle, at.x, at.y);
      nodes.push_back(nodeAt(place, numberOf(number + n, r, 2)));
      const double measure = stride * grid.measureOf(line);
      for (size_t c = 0; c < 3; ++c)
        measures_[place.nodes[c]] += measure * double{place.weights[c]};
    }
  });

  for (uint32_t node = 0; node < block.nodes(); ++node) {
    const double even = double{kPi * block.area(node)};
    gains_.push_back(measures_[node] > 0
                         ? static_cast<float>(std::clamp(even / measures_[node], 0.25, 4.0))
                         : 1.0f);
  }

  first_.assign(block.nodes() + 1, 0);
  for (const uint32_t node : nodes) ++first_[node + 1];
  for (size_t node = 0; node < block.nodes(); ++node) first_[node + 1] += first_[node];
  std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
  entries_.resize(found.size()), cumulative_.resize(found.size());
  for (size_t k = 0; k < found.size(); ++k) entries_[next[nodes[k]]++] = found[k];
  for (size_t node = 0; node < block.nodes(); ++node) {
    double sum = 0;
    for (uint32_t e = first_[node]; e < first_[node + 1]; ++e) {
      sum += stride * grid.measureOf(grid.lineOf(entries_[e].line));
      cumulative_[e] = static_cast<float>(sum);
    }
  }
}

size_t NodeLines::bytesOf(uint64_t hits, size_t nodes) {
  return (sizeof(Entry) + sizeof(float)) * (hits / strideOf(hits, nodes)) +
         (sizeof(uint32_t) + sizeof(double) + sizeof(float)) * nodes;
}

std::optional<NodeLines::Start> NodeLines::choose(const LineField& field, uint32_t node,
                                                  float u) const {
  const auto begin = cumulative_.begin() + first_[node],
             end = cumulative_.begin() + first_[node + 1];
  if (begin == end) return std::nullopt;
  const auto at = std::upper_bound(begin, end, u * *(end - 1));
  const Entry& entry = entries_[static_cast<size_t>(std::min(at, end - 1) - cumulative_.begin())];
  const GridLine line = field.grid().lineOf(entry.line);
  const LineRun& run = field.local(instance_).runs()[entry.run];
  return Start{line, {instance_, run.triangle, run.at(line.m)}};
}

}  // namespace ninefold
