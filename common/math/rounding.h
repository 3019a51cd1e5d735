// rounding.h: bounds of float rounding errors, from which robust ray origins are made.
//
// The unit roundoff is u = 2^-24: one correctly rounded operation has a relative error of at most
// u. A triangle has corners a, b, c, unit normal n, edges e0 = c-a, e1 = a-b, and a bounding box
// with side lengths x. Then p may seem to be off its plane, or on the wrong side, by
//
//   storing p in floats           u |n| . |p|                                               [m]
//   a ray test that starts at p   u (12 x . |n| + 4 sum_i x_i m_i / |e0 x e1| + max_i x_i)  [m]
//
// The ray test is Embree's watertight one (Pluecker). Its three terms are
//   12 x . |n|   rounded corners relative to the origin, and their edges
//   sum x_i m_i  the cross product: component i is a difference of two products of size m_i
//   max_i x_i    keeps the origin out of an axis-aligned plane, where the other terms vanish
// A test whose origin is at distance d errs by about u d more: kRayRounding.
//
// Source:  Pharr, Jakob, Humphreys, "Physically Based Rendering" 3.9, for the manner.
// Proved:  tests/tracing (a million rays never meet the triangle that they start from).
// Threads: pure.
#pragma once

#include "common/math/vec.h"

namespace ninefold {

inline constexpr float kUnitRoundoff = 0x1p-24f;

// Bound [m] of how far rounding its coordinates puts p off a plane with unit normal n.
inline float storageError(Vec3 p, Vec3 n) {
  return kUnitRoundoff * glm::dot(glm::abs(p), glm::abs(n));
}

// Error of a ray test at distance d from the ray's origin, in units of d.
inline constexpr float kRayRounding = 16 * kUnitRoundoff;

// p = a + u(b-a) + v(c-a), made by pointOnTriangle and stored in floats, may be taken to lie on the
// wrong side of the plane of triangle (a, b, c) up to this distance [m]: planeError, the same all
// over the triangle, plus the storing of p. n: unit normal of the triangle, of either sign.
float planeError(Vec3 a, Vec3 b, Vec3 c, Vec3 n);
inline float triangleError(Vec3 a, Vec3 b, Vec3 c, Vec3 n, Vec3 p) {
  return storageError(p, n) + planeError(a, b, c, n);
}

// The point with barycentrics u (of b) and v (of c), rounded only once.
Vec3 pointOnTriangle(Vec3 a, Vec3 b, Vec3 c, float u, float v);

// cross(b - a, c - a): the right direction even for slivers; its length is twice the area [m^2].
DVec3 exactNormal(Vec3 a, Vec3 b, Vec3 c);

}  // namespace ninefold
