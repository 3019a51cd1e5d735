// warp.h: maps from the unit square to the domains that light transport samples, each beside its
// density. Every map is continuous and area-preserving up to its density. Local frames: z = normal.
// Proved:  tests/sampling/warp_test.cpp (chi-square of samples against densities; continuity).
// Threads: pure functions. Arguments u are in [0, 1)^2.
#pragma once

#include "common/math/units.h"

namespace ninefold {

// Concentric map to the unit disk; density 1/pi per unit area. Shirley and Chiu 1997.
Vec2 squareToDisk(Vec2 u);

// Direction with density cos(theta)/pi per solid angle; z > 0.
Vec3 squareToCosineHemisphere(Vec2 u);
inline float cosineHemispherePdf(float cosTheta) { return std::max(cosTheta, 0.0f) * kInvPi; }

// Uniform directions, the centre of the square at +z: density 1/(4 pi).
Vec3 squareToSphere(Vec2 u);
inline constexpr float kSpherePdf = 0.25f * kInvPi;

// Uniform in the cone of half angle theta_max around z: density 1/(2 pi (1 - cos theta_max)).
// `oneMinusCos` = 1 - cos theta_max in (0, 2]: thin cones would lose it to cancellation.
Vec3 squareToCone(Vec2 u, float oneMinusCos);
inline float conePdf(float oneMinusCos) { return 1.0f / (2.0f * kPi * oneMinusCos); }

// Barycentrics (b1, b2) of a uniform point of a triangle; density 1/area. Heitz 2019.
Vec2 squareToTriangle(Vec2 u);

}  // namespace ninefold
