#include "common/scene/twist.h"

#include <algorithm>
#include <cmath>

namespace ninefold {
namespace {

DVec3 turned(DVec3 v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v.x + s * v.z, v.y, c * v.z - s * v.x};
}

}  // namespace

std::vector<ShapeEdit> twisted(const Scene& scene, uint32_t mesh, const DMat4& toWorld,
                               const Twist& twist) {
  const Mesh& from = scene.meshes[mesh];
  const DMat4 toMesh = glm::inverse(toWorld);
  const DMat3 normalToWorld = glm::transpose(DMat3(toMesh));
  const DMat3 normalToMesh = glm::transpose(DMat3(toWorld));
  const double height = twist.high - twist.low;
  std::vector<Vec3> positions, normals;
  for (size_t i = 0; i < from.positions.size(); ++i) {
    const DVec3 at = DVec3(toWorld * DVec4(DVec3(from.positions[i]), 1)) - twist.centre;
    const double share = (at.y + twist.centre.y - twist.low) / height;
    const double angle = twist.angle * std::clamp(share, 0.0, 1.0);
    positions.emplace_back(DVec3(toMesh * DVec4(turned(at, angle) + twist.centre, 1)));
    if (from.normals.empty()) continue;
    const double steepness = share > 0 && share < 1 ? twist.angle / height : 0;
    const DVec3 n = normalToWorld * DVec3(from.normals[i]);
    const DVec3 sideways(at.z, 0, -at.x);
    const DVec3 leant = n - DVec3(0, steepness * glm::dot(sideways, n), 0);
    normals.emplace_back(glm::normalize(normalToMesh * turned(leant, angle)));
  }
  return shapeEdits(mesh, positions, normals);
}

}  // namespace ninefold
