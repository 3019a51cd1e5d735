// basis.h: an orthonormal frame around a unit normal, so that local z is the normal.
// Source: Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017 (branchless, stable at
//         z = -1).
#pragma once

#include "common/math/vec.h"

namespace ninefold {

struct Basis {
  Vec3 tangent, bitangent, normal;

  explicit Basis(Vec3 n) : normal(n) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    tangent = Vec3(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x);
    bitangent = Vec3(b, sign + n.y * n.y * a, -n.y);
  }
  Vec3 toWorld(Vec3 v) const { return v.x * tangent + v.y * bitangent + v.z * normal; }
  Vec3 toLocal(Vec3 v) const {
    return Vec3(glm::dot(v, tangent), glm::dot(v, bitangent), glm::dot(v, normal));
  }
};

}  // namespace ninefold
