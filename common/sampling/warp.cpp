#include "common/sampling/warp.h"

namespace ninefold {

namespace {

// [0,1) to (-1,1). Samples are multiples of 2^-24; taking the middle of each such cell keeps the
// map symmetric and its values away from -1, 0 and 1, so that no direction has density 0.
float signedUnit(float u) { return 2.0f * u - (1.0f - 0x1p-24f); }

struct Polar {
  Vec2 unit;  // direction in the plane
  float r;    // signed distance from the centre, in (-1, 1)
};

// The square's concentric squares become circles: r is the larger coordinate, the angle the ratio.
Polar squareToPolar(Vec2 u) {
  const float a = signedUnit(u.x), b = signedUnit(u.y);
  const bool wide = std::abs(a) > std::abs(b);
  const float angle = 0.25f * kPi * (wide ? b / a : b == 0 ? 0.0f : a / b);
  const float c = std::cos(angle), s = std::sin(angle);
  return wide ? Polar{Vec2(c, s), a} : Polar{Vec2(s, c), b};
}

}  // namespace

Vec2 squareToDisk(Vec2 u) {
  const Polar p = squareToPolar(u);
  return p.r * p.unit;
}

Vec3 squareToCosineHemisphere(Vec2 u) {
  const Polar p = squareToPolar(u);
  const Vec2 d = p.r * p.unit;
  return Vec3(d.x, d.y, std::sqrt((1.0f - p.r) * (1.0f + p.r)));
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
