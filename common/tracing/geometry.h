// geometry.h: an instance flattened to world space, and the surface at a point of one of its
// triangles. Knows nothing of Embree. Corners keep the mesh's order, so that barycentrics mean the
// same everywhere.
//
// Owner:   world-space vertices; shares the mesh.
// Threads: const after construction.   Errors: none for valid scenes.
#pragma once

#include <memory>
#include <vector>

#include "common/scene/scene.h"
#include "common/tracing/tracer.h"

namespace ninefold {

// How far geometry may reach from the origin [m]: products of three lengths stay in floats' range.
inline constexpr float kMaxDistance = 1e11f;

class InstanceGeometry {
 public:
  InstanceGeometry(const Scene& scene, const Instance& instance);

  const Mesh& mesh() const { return *mesh_; }
  // World-space positions [m] of the mesh's vertices; one more follows, as padding for Embree.
  const Vec3* vertices() const { return vertices_.data(); }
  const Bounds& bounds() const { return bounds_; }
  // In world space, in the mesh's order.
  Tracer::Corners corners(uint32_t triangle) const;
  // Unit; 0 for a triangle without area.
  Vec3 frontNormal(uint32_t triangle) const { return planes_[triangle].normal; }

  // The surface at barycentrics (u, v), clamped into the triangle. Leaves p.instance alone.
  void surface(uint32_t triangle, float u, float v, SurfacePoint& p) const;

 private:
  // What every hit asks of a triangle, worked out once.
  struct Plane {
    Vec3 normal;         // of the front, unit; 0 for a triangle without area
    float error;         // planeError, see math/rounding.h [m]
    Vec3 shadingNormal;  // if it is the same all over the triangle
    bool flat;           // it is
  };

  void flatten(const Instance& instance);
  Plane planeOf(uint32_t triangle) const;
  void setTexture(const Triangle& t, const Vec3& weights, SurfacePoint& p) const;
  bool isFlat(const Triangle& t) const;
  // Unit, on the side of `plane`, the geometric normal.
  Vec3 shadingNormal(const Triangle& t, const Vec3& weights, const Vec3& plane) const;
  void setTangent(const Triangle& t, const Tracer::Corners& at, const Vec3& weights,
                  SurfacePoint& p) const;

  std::shared_ptr<const Mesh> mesh_;
  bool tangents_ = false;  // whether anything reads them: a normal map
  Bounds bounds_;
  std::vector<Vec3> vertices_;
  std::vector<Plane> planes_;  // one a triangle
  Mat3 directionToWorld_{1};   // both only up to a positive factor
  Mat3 normalToWorld_{1};
  float handedness_ = 1;  // -1: the instance mirrors, and the front is where corners run clockwise
};

}  // namespace ninefold
