// vec.h: the vector types. Column vectors; right-handed coordinates, y up as in glTF; metres.
#pragma once

#define GLM_FORCE_EXPLICIT_CTOR
#define GLM_FORCE_XYZW_ONLY
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace ninefold {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Vec4 = glm::vec4;
using DVec3 = glm::dvec3;
using DVec4 = glm::dvec4;
using Mat3 = glm::mat3;
using DMat3 = glm::dmat3;
using DMat4 = glm::dmat4;
using Triangle = glm::u32vec3;  // three vertex indices

inline float maxComponent(Vec3 v) { return std::max(v.x, std::max(v.y, v.z)); }
inline bool isBlack(Vec3 v) { return v.x == 0 && v.y == 0 && v.z == 0; }
inline bool isFinite(Vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Luminance of linear Rec. 709 radiance, same unit as the argument.
inline float luminance(Vec3 rgb) { return 0.2126f * rgb.x + 0.7152f * rgb.y + 0.0722f * rgb.z; }

}  // namespace ninefold
