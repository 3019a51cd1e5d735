// rounding.h: bounds of float rounding errors, from which robust ray origins are made.
//
// u = 2^-24 is the unit roundoff: one correctly rounded operation has a relative error of at most
// u. For a triangle with corners a, b, c, unit normal n, edges e0 = c-a, e1 = a-b and box side
// lengths x:
//
//   storing a point p            |n| . u |p|                    distance by which p may leave its
//   plane a ray test that starts at p  u (12 x . |n| + 4 sum_i x_i m_i / |e0 x e1|)
//
// The second is what the watertight (Pluecker) ray-triangle test of Embree can err about on which
// side of the plane its origin lies: rounded corners relative to the origin, their edges, and the
// cross product, whose component i is a difference of two products and errs by no more than their
// size m_i. Both terms vanish in axis-aligned planes, where the test is exact: there u max_i x_i
// keeps the origin from lying in the plane itself. A test whose origin is d away errs by about u d
// more: kRayRounding. Source: Pharr, Jakob, Humphreys, "Physically Based Rendering" 3.9, for the
// manner. Proved: tests/tracing (a million rays never meet the triangle that they start from).
// Threads: pure.
#pragma once

#include "common/math/vec.h"

namespace ninefold {

inline constexpr float kUnitRoundoff = 0x1p-24f;

// Bound of the distance that rounding its coordinates puts between p and a plane with unit normal n
// [m].
inline float storageError(Vec3 p, Vec3 n) {
  return kUnitRoundoff * glm::dot(glm::abs(p), glm::abs(n));
}

// Error of a ray test at distance d from the ray's origin, in units of d.
inline constexpr float kRayRounding = 16 * kUnitRoundoff;

// Bound of the distance [m] from the plane of triangle (a, b, c) at which a point p = a + u(b-a) +
// v(c-a), computed with care (pointOnTriangle) and stored in floats, may be taken to lie on the
// wrong side: planeError, which is the same all over the triangle, and the storing of p. n: unit
// normal of the triangle, of either sign.
float planeError(Vec3 a, Vec3 b, Vec3 c, Vec3 n);
inline float triangleError(Vec3 a, Vec3 b, Vec3 c, Vec3 n, Vec3 p) {
  return storageError(p, n) + planeError(a, b, c, n);
}

// The point with barycentrics u (of b) and v (of c), rounded only once.
Vec3 pointOnTriangle(Vec3 a, Vec3 b, Vec3 c, float u, float v);

// cross(b - a, c - a) with the right direction even for slivers; its length is twice the area
// [m^2].
DVec3 exactNormal(Vec3 a, Vec3 b, Vec3 c);

}  // namespace ninefold
