// warp.h: maps from the unit square to the domains that light transport samples, each beside its
// density. Every map is continuous and has just this density. Local frames: z = normal.
// Arguments u are in [0, 1)^2.
//
// Proved:  tests/sampling/warp_test.cpp (chi-square of samples against densities; continuity).
// Threads: pure functions.
#pragma once

#include "common/math/units.h"

namespace ninefold {

// [0,1) to (-1,1). A sample is a multiple of 2^-24; this takes the middle of its cell. So the map
// is symmetric and never gives -1, 0 or 1, and no direction has density 0.
inline float signedUnit(float u) { return 2.0f * u - (1.0f - 0x1p-24f); }

struct Polar {
  Vec2 unit;  // direction in the plane
  float r;    // signed distance from the centre, in (-1, 1)
};

// Sine and cosine of pi/4 x for |x| <= 1, to 1e-7. Taylor's series has the same bits with every
// library.
inline float sineOfEighth(float x) {
  const float a = 0.25f * kPi * x, a2 = a * a;
  return a * (1 + a2 * (-1.0f / 6 + a2 * (1.0f / 120 + a2 * (-1.0f / 5040 + a2 / 362880))));
}
inline float cosineOfEighth(float x) {
  const float a = 0.25f * kPi * x, a2 = a * a;
  return 1 + a2 * (-1.0f / 2 + a2 * (1.0f / 24 + a2 * (-1.0f / 720 + a2 / 40320)));
}

// Concentric squares become circles: r is the larger coordinate, the angle is the ratio of both.
inline Polar squareToPolar(Vec2 u) {
  const float a = signedUnit(u.x), b = signedUnit(u.y);
  const bool wide = std::abs(a) > std::abs(b);
  const float r = wide ? a : b, x = r == 0 ? 0.0f : (wide ? b : a) / r;
  const float c = cosineOfEighth(x), s = sineOfEighth(x);
  return {wide ? Vec2(c, s) : Vec2(s, c), r};
}

// Concentric map to the unit disk; density 1/pi per unit area. Shirley and Chiu 1997.
Vec2 squareToDisk(Vec2 u);

// Direction with density cos(theta)/pi per solid angle; z > 0.
inline Vec3 squareToCosineHemisphere(Vec2 u) {
  const Polar p = squareToPolar(u);
  const Vec2 d = p.r * p.unit;
  return Vec3(d.x, d.y, std::sqrt((1.0f - p.r) * (1.0f + p.r)));
}
inline float cosineHemispherePdf(float cosTheta) { return std::max(cosTheta, 0.0f) * kInvPi; }

// Uniform directions, density 1/(4 pi); the centre of the square goes to +z.
Vec3 squareToSphere(Vec2 u);
inline constexpr float kSpherePdf = 0.25f * kInvPi;

// Uniform in the cone of half angle theta_max around z: density 1/(2 pi (1 - cos theta_max)).
// `oneMinusCos` = 1 - cos theta_max in (0, 2]; as a difference thin cones would lose it.
Vec3 squareToCone(Vec2 u, float oneMinusCos);
inline float conePdf(float oneMinusCos) { return 1.0f / (2.0f * kPi * oneMinusCos); }

// Barycentrics (b1, b2) of a uniform point of a triangle; density 1/area [1/m^2]. Heitz 2019.
Vec2 squareToTriangle(Vec2 u);

}  // namespace ninefold
