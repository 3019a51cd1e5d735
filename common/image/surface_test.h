// surface_test.h: do two pixels see the same smooth piece of surface? The test of the discontinuity
// buffer. Symmetric, bit for bit: if p accepts q then q accepts p. A pixel without x never passes.
//
//   none     never: every pixel keeps its own E
//   paper    |d_p - d_q| <= kPaperDistance min(d_p, d_q)  and  n_p . n_q >= kPaperNormal
//   surface  in the first layer: n_p . n_q >= kSurfaceNormal, and the tangent planes at both ends
//            predict the neighbour, as follows
//   mirrors  behind a reflection or refraction there are no such planes: distance and normal as in
//            `paper`, with wider limits in `surface`; and both must have the same chain
//
// On a plane, inverse depth u = 1/z is linear in image coordinates:
//
//   u(q) = u_p + grad_p . (q-p)        grad_p = u_p (n_p . step)/(n_p . v_p)
//
// v is the pixel's ray direction scaled to depth 1, step its change from pixel to pixel. With
// parallel rays the depth itself is linear: u = z, grad_p = -(n_p . step)/(n_p . v), and step goes
// from one ray's start to the next one's. Projection keeps convexity. So on any convex or concave
// surface the true difference lies between the predictions of the two ends; across a step in depth
// it does not:
//
//   min(a, b) - s <= u_q - u_p <= max(a, b) + s        a = grad_p . (q-p), b = grad_q . (q-p)
//
// The slack s is the larger of both ends' |grad|_1 (film positions are spread over the pixel: p and
// q may be a pixel off) plus kFootprints pixel footprints at their distance.
//
// Source:  Keller 1998 (discontinuity buffer); Wald et al. 2002. They give no thresholds: those
//          here are ours, and so is the test by tangent planes.
// Proved:  tests/image/discontinuity_buffer_test.cpp.   Threads: pure.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace ninefold {

enum class SurfaceTest : uint8_t { none, paper, surface };

inline constexpr float kPaperDistance = 0.05f;
inline constexpr float kPaperNormal = 0.95f;   // 18 degrees
inline constexpr float kSurfaceNormal = 0.5f;  // 60 degrees
inline constexpr float kMirrorDistance = 0.1f;
inline constexpr float kMirrorNormal = 0.7f;  // 45 degrees
inline constexpr float kFootprints = 1.0f;
// Cosine between view ray and surface below which the tangent plane's slope is no longer believed.
inline constexpr float kGrazingCosine = 0.02f;

// What the surface test needs of a pixel besides its normal: u = 0 where there is no x.
struct SurfaceGuide {
  float u = 0;                 // inverse depth [1/m], or depth [m] of parallel rays
  float gradX = 0, gradY = 0;  // its change per pixel on the tangent plane
  float slack = 0;
};

// These functions avoid short-circuit evaluation on purpose: they stand in vectorised loops.
inline bool predictsNeighbour(const SurfaceGuide& p, const SurfaceGuide& q, float dx, float dy) {
  const float fromP = p.gradX * dx + p.gradY * dy;
  const float fromQ = q.gradX * dx + q.gradY * dy;
  const float slack = std::max(p.slack, q.slack);
  const float difference = q.u - p.u;
  return bool(int(p.u > 0) & int(q.u > 0) & int(difference >= std::min(fromP, fromQ) - slack) &
              int(difference <= std::max(fromP, fromQ) + slack));
}

inline bool similarDistance(float p, float q, float tolerance) {
  return bool(int(p > 0) & int(q > 0) & int(std::abs(p - q) <= tolerance * std::min(p, q)));
}

}  // namespace ninefold
