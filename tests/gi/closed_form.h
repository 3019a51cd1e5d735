// closed_form.h: irradiance and form factors that have a formula, in double precision.
// Source: Howell, "A Catalog of Radiation Heat Transfer Configuration Factors".
#pragma once

#include <cmath>
#include <vector>

#include "common/math/vec.h"

namespace ninefold::testing {

inline const double kExactPi = std::acos(-1.0);

// Lambert's formula: E at x with unit normal n under a polygon of radiance 1, all of it above the
// horizon: E = 1/2 |sum of gamma_i cos_i| over the edges, gamma the angle that an edge subtends,
// cos the cosine between n and the normal of the plane through x and the edge.
inline double lambert(const std::vector<DVec3>& corners, DVec3 x, DVec3 n) {
  double sum = 0;
  for (size_t i = 0; i < corners.size(); ++i) {
    const DVec3 a = glm::normalize(corners[i] - x);
    const DVec3 b = glm::normalize(corners[(i + 1) % corners.size()] - x);
    const DVec3 across = glm::cross(a, b);
    sum += std::atan2(glm::length(across), glm::dot(a, b)) * glm::dot(glm::normalize(across), n);
  }
  return std::abs(sum) / 2;
}

// Form factor between two directly opposed unit squares at distance d, x = 1/d.
inline double oppositeSquares(double d) {
  const double x = 1 / d, x1 = 1 + x * x;
  return 2 / (kExactPi * x * x) *
         (0.5 * std::log(x1 * x1 / (1 + 2 * x * x)) +
          2 * x * std::sqrt(x1) * std::atan(x / std::sqrt(x1)) - 2 * x * std::atan(x));
}

// Form factor between two unit squares at a right angle with a common edge.
inline double squaresWithACommonEdge() {
  return (2 * std::atan(1.0) - std::sqrt(2.0) * std::atan(1 / std::sqrt(2.0)) +
          0.25 * std::log(4.0 / 3.0 * 3.0 / 4.0 * 3.0 / 4.0)) /
         kExactPi;
}

// Form factor from a sphere to a disk of radius R, its axis through the sphere's middle at height
// h: the sphere's own radius does not matter.
inline double sphereToDisk(double h, double R) { return (1 - h / std::hypot(h, R)) / 2; }

}  // namespace ninefold::testing
