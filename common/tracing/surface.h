// surface.h: a hit, the surface point at it, and where rays from it may safely start.
//
// Robust origins: rounding may put the point, or the ray test's idea of it, off its surface. The
// triangle's corners bound how far (math/rounding.h), and a new ray starts outside that bound along
// the geometric normal. There is no scene-dependent epsilon. At the far end of a segment the ray
// test also errs in proportion to the length: end a segment from x to y at
// offsetOrigin(y, n, error + kRayRounding * length, x - y), farT = 1.
//
// Source:  Pharr, Jakob, Humphreys, "Physically Based Rendering" 3.9 (errors of intersections).
// Threads: plain values.
#pragma once

#include <array>
#include <cstdint>

#include "common/math/vec.h"

namespace ninefold {

struct Hit {
  uint32_t instance = ~0u;  // index into Scene::instances
  uint32_t triangle = 0;    // index into the mesh's triangles
  float u = 0, v = 0;       // barycentrics of the second and third corner
  float t = 0;              // along the ray

  static Hit none() { return Hit{}; }
  explicit operator bool() const { return instance != ~0u; }
};

// A solid (a dielectric with an inside) whose surface lies in the one that was hit, see contacts.h.
struct SolidContact {
  int material = 0;
  bool sameSide = true;  // its front is on the same side
};

struct SurfacePoint {
  static constexpr int kMaxContacts = 3;

  Vec3 position{0};
  Vec3 geometricNormal{0};  // unit; front side by winding (mirrored instances are turned right)
  Vec3 shadingNormal{0};    // unit, interpolated; on the geometric normal's side; no normal map yet
  Vec3 tangent{1, 0, 0};    // unit, along increasing u of uv0 where the material has a normal map
  float tangentSign = 1;    // bitangent = tangentSign * cross(normal, tangent)
  Vec2 uv0{0}, uv1{0};
  Vec4 color{1};  // of the vertices: linear, times the material's colour and opacity
  uint32_t instance = 0, triangle = 0;
  float u = 0, v = 0;  // barycentrics of the second and third corner, within the triangle
  int material = 0;
  float error = 0;  // bound of the distance of `position` from the exact surface [m]
  std::array<SolidContact, kMaxContacts> contacts;
  int contactCount = 0;
};

// Start of a ray from `p` into `direction`: moved off, to the side into which it goes.
Vec3 offsetOrigin(const SurfacePoint& p, Vec3 direction);
// The same for raw values: n = unit geometric normal, error as above.
Vec3 offsetOrigin(Vec3 position, Vec3 n, float error, Vec3 direction);

}  // namespace ninefold
