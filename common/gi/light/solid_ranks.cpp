#include "common/gi/light/solid_ranks.h"

#include <algorithm>

namespace ninefold {
namespace {

bool isSolid(const Material& m) { return m.solid && transmits(m); }

double enclosedVolume(const Mesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const DVec3 origin(mesh.positions[mesh.triangles[0].x]);
    const DVec3 a = DVec3(mesh.positions[t.x]) - origin, b = DVec3(mesh.positions[t.y]) - origin,
                c = DVec3(mesh.positions[t.z]) - origin;
    sum += glm::dot(a, glm::cross(b, c));
  }
  return std::abs(sum) / 6;
}

}  // namespace

std::vector<int> solidRanks(const Scene& scene) {
  std::vector<int> ranks(scene.materials.size(), 0), solids;
  for (size_t i = 0; i < scene.materials.size(); ++i)
    if (isSolid(scene.materials[i])) solids.push_back(static_cast<int>(i));
  if (solids.size() < 2) return ranks;

  std::vector<double> volume(scene.materials.size(), 0);
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
    if (!isSolid(scene.materials[static_cast<size_t>(mesh.material)])) continue;
    double& largest = volume[static_cast<size_t>(mesh.material)];
    const double scale = std::abs(glm::determinant(DMat3(instance.toWorld)));
    largest = std::max(largest, scale * enclosedVolume(mesh));
  }
  std::stable_sort(solids.begin(), solids.end(), [&](int a, int b) {
    return volume[static_cast<size_t>(a)] > volume[static_cast<size_t>(b)];
  });
  for (size_t i = 0; i < solids.size(); ++i)
    ranks[static_cast<size_t>(solids[i])] = static_cast<int>(i);
  return ranks;
}

}  // namespace ninefold
