#include "common/scene/deformation.h"

namespace ninefold {
namespace {

void add(const std::vector<Vec3>& delta, float weight, std::vector<Vec3>& to) {
  if (delta.empty()) return;
  for (size_t i = 0; i < to.size(); ++i) to[i] += weight * delta[i];
}

}  // namespace

DMat4 Holds::matrixOf(size_t vertex, std::span<const DMat4> joints) const {
  DMat4 sum(0);
  double total = 0;
  for (size_t i = vertex == 0 ? 0 : ends[vertex - 1]; i < ends[vertex]; ++i) {
    sum += double(holds[i].weight) * joints[holds[i].joint];
    total += double(holds[i].weight);
  }
  return sum / total;
}

Holds Holds::of(const std::vector<uint32_t>& vertices) const {
  Holds some;
  if (empty()) return some;
  for (const uint32_t vertex : vertices) {
    for (size_t i = vertex == 0 ? 0 : ends[vertex - 1]; i < ends[vertex]; ++i)
      some.holds.push_back(holds[i]);
    some.ends.push_back(some.holds.size());
  }
  return some;
}

std::vector<DMat4> jointMatrices(const Skin& skin, std::span<const DMat4> movers) {
  std::vector<DMat4> matrices;
  for (const Joint& joint : skin.joints) {
    DMat4 world = joint.mover < 0 ? joint.world : movers[static_cast<size_t>(joint.mover)];
    world[3] -= DVec4(skin.place, 0);
    matrices.push_back(world * joint.inverseBind);
  }
  return matrices;
}

void addMorphs(const std::vector<MorphTarget>& targets, std::span<const double> weights,
               std::vector<Vec3>& positions, std::vector<Vec3>& normals) {
  for (size_t k = 0; k < targets.size() && k < weights.size(); ++k) {
    const auto weight = static_cast<float>(weights[k]);
    if (weight == 0) continue;
    add(targets[k].positions, weight, positions);
    add(targets[k].normals, weight, normals);
  }
}

DMat3 normalMatrix(const DMat3& m) {
  const DMat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  return glm::determinant(m) < 0 ? -cofactors : cofactors;
}

}  // namespace ninefold
