#include "common/math/rounding.h"

namespace ninefold {

Vec3 pointOnTriangle(Vec3 a, Vec3 b, Vec3 c, float u, float v) {
  const DVec3 origin(a);
  return Vec3(origin + double(u) * (DVec3(b) - origin) + double(v) * (DVec3(c) - origin));
}

DVec3 exactNormal(Vec3 a, Vec3 b, Vec3 c) {
  const DVec3 origin(a);
  return glm::cross(DVec3(b) - origin, DVec3(c) - origin);
}

float planeError(Vec3 a, Vec3 b, Vec3 c, Vec3 n) {
  const Vec3 box = glm::max(a, glm::max(b, c)) - glm::min(a, glm::min(b, c));
  // Component i of a normal is a difference of two products. These are the products of a pair of
  // edges; the ray test chooses the pair with the smaller ones.
  const auto products = [](Vec3 e, Vec3 f) {
    return glm::abs(Vec3(e.z * f.y, e.x * f.z, e.y * f.x));
  };
  const Vec3 m = glm::min(products(c - a, a - b), products(a - b, b - c));
  const float twiceArea = glm::length(glm::cross(c - a, a - b));
  const float edges = 12 * glm::dot(box, glm::abs(n));
  const float cross = twiceArea > 0 ? 4 * glm::dot(box, m) / twiceArea : 0;
  // Never 0: an origin exactly in an axis-aligned plane is met again at t = 0.
  const float least = std::max(box.x, std::max(box.y, box.z));
  return kUnitRoundoff * (edges + cross + least);
}

}  // namespace ninefold
