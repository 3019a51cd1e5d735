#include "common/sampling/warp.h"

namespace ninefold {

Vec2 squareToDisk(Vec2 u) {
  const Polar p = squareToPolar(u);
  return p.r * p.unit;
}

Vec3 squareToSphere(Vec2 u) { return squareToCone(u, 2.0f); }

// Height is uniform on a sphere: 1 - cos = r^2 (1 - cos_max), and sin^2 = (1 - cos)(1 + cos).
Vec3 squareToCone(Vec2 u, float oneMinusCos) {
  const Polar p = squareToPolar(u);
  const float lost = p.r * p.r * oneMinusCos;
  const Vec2 d = p.r * std::sqrt(oneMinusCos * (2.0f - lost)) * p.unit;
  return Vec3(d.x, d.y, 1.0f - lost);
}

// Folds the square over its diagonal by halving one coordinate and shearing the other.
Vec2 squareToTriangle(Vec2 u) {
  if (u.y > u.x) {
    const float b1 = 0.5f * u.x;
    return Vec2(b1, u.y - b1);
  }
  const float b2 = 0.5f * u.y;
  return Vec2(u.x - b2, b2);
}

}  // namespace ninefold
