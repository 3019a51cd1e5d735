#include "common/gi/light/aim_targets.h"

#include <map>

#include "common/scene/world.h"

namespace ninefold {
namespace {

using BoundsOfNodes = std::map<int, Bounds>;

// World bounds of each node that holds an instance that focuses light.
BoundsOfNodes focusingBounds(const Scene& scene, const Shader& shader) {
  BoundsOfNodes byNode;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
    if (!shader.focuses(mesh.material)) continue;
    for (const Vec3& p : mesh.positions) byNode[instance.node].add(worldPoint(instance.toWorld, p));
  }
  return byNode;
}

struct Group {
  Bounds bounds;
  std::vector<int> nodes;
};

Bounds joined(Bounds a, const Bounds& b) {
  a.add(b.low), a.add(b.high);
  return a;
}

Group joined(Group a, const Group& b) {
  a.bounds = joined(a.bounds, b.bounds);
  a.nodes.insert(a.nodes.end(), b.nodes.begin(), b.nodes.end());
  return a;
}

// Joins the two boxes whose union grows least, until few enough are left. Neighbours in file order
// are joined first, so that thousands of objects cost no cubic time.
void mergeTo(std::vector<Group>& groups, size_t limit) {
  while (groups.size() > 8 * limit) {
    std::vector<Group> halved;
    for (size_t i = 0; i + 1 < groups.size(); i += 2)
      halved.push_back(joined(std::move(groups[i]), groups[i + 1]));
    if (groups.size() % 2 == 1) halved.push_back(std::move(groups.back()));
    groups = std::move(halved);
  }
  while (groups.size() > limit) {
    size_t bestA = 0, bestB = 1;
    float best = std::numeric_limits<float>::infinity();
    for (size_t a = 0; a < groups.size(); ++a)
      for (size_t b = a + 1; b < groups.size(); ++b) {
        const float r = joined(groups[a].bounds, groups[b].bounds).radius();
        if (r < best) best = r, bestA = a, bestB = b;
      }
    groups[bestA] = joined(std::move(groups[bestA]), groups[bestB]);
    groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(bestB));
  }
}

Sphere sphereAround(const Bounds& bounds) {
  return {bounds.centre(), std::max(bounds.radius(), 1e-30f) * 1.0001f};
}

// True if the targets are around all of these nodes and no other.
bool areAround(const std::vector<AimTarget>& targets, const BoundsOfNodes& byNode) {
  size_t nodes = 0;
  for (const AimTarget& target : targets)
    for (const int node : target.nodes) nodes += byNode.contains(node) ? 1 : byNode.size() + 1;
  return nodes == byNode.size();
}

}  // namespace

std::vector<AimTarget> aimTargets(const Scene& scene, const Shader& shader,
                                  const std::vector<AimTarget>* begun) {
  const BoundsOfNodes byNode = focusingBounds(scene, shader);
  if (begun != nullptr && areAround(*begun, byNode)) {
    std::vector<AimTarget> targets = *begun;
    for (AimTarget& target : targets) {
      Bounds bounds;
      for (const int node : target.nodes) bounds = joined(bounds, byNode.at(node));
      target.now = sphereAround(bounds);
    }
    return targets;
  }
  std::vector<Group> groups;
  for (const auto& [node, bounds] : byNode) groups.push_back({bounds, {node}});
  mergeTo(groups, kMaxTargets);
  std::vector<AimTarget> targets;
  for (Group& group : groups) {
    const Sphere sphere = sphereAround(group.bounds);
    targets.push_back({sphere, sphere, std::move(group.nodes)});
  }
  return targets;
}

}  // namespace ninefold
