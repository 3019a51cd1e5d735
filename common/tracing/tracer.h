// tracer.h: closest hit and occlusion on a whole scene. The only door to Embree (versions 3 and 4).
//
// All instances are flattened to world-space triangles, one geometry per instance (geomID =
// instance index). One thread builds the hierarchy with fixed quality: all clients of a class have
// the same one. After an edit, instances that ever moved have hierarchies of their own beside that
// of the scene as it was read, where rays do not see them any more. What the edit left alone is
// shared with the tracer before. The caller names the moved ones, so that the result does not
// depend on how it came about.
// Filter functions pass through alpha-masked texels. Back faces are hit like front faces. The
// robust traversal is used: no cracks between triangles that share an edge.
//
// Owner:   holds flattened geometry; refers to the Scene, which must outlive it.
// Threads: const functions are reentrant.
// Errors:  constructor throws Error when memory or the instruction set is missing, or when the
//          scene is larger than rays can be traced in. A ray that is not finite hits nothing.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/scene/scene.h"
#include "common/tracing/surface.h"

namespace ninefold {

inline constexpr int kPacket = 16;

// Sixteen rays, planar, in Embree's own layout: nothing is copied at the call.
// A ray covers origin + t * direction for t in [nearT, farT]; directions need not be unit.
struct alignas(64) RayPacket {
  float originX[kPacket], originY[kPacket], originZ[kPacket];
  float nearT[kPacket];
  float directionX[kPacket], directionY[kPacket], directionZ[kPacket];
  float time[kPacket];
  float farT[kPacket];  // closest: the hit's t on return; occluded: negative infinity if blocked
  uint32_t mask[kPacket], id[kPacket], flags[kPacket];

  void set(size_t lane, Vec3 origin, Vec3 direction, float tNear, float tFar) {
    originX[lane] = origin.x, originY[lane] = origin.y, originZ[lane] = origin.z;
    directionX[lane] = direction.x, directionY[lane] = direction.y, directionZ[lane] = direction.z;
    nearT[lane] = tNear, farT[lane] = tFar;
    time[lane] = 0, mask[lane] = ~0u, id[lane] = 0, flags[lane] = 0;
  }
};

enum class Isa : uint8_t { automatic, avx2, avx512 };

struct RayLog;      // ray_log.h
struct RayAnswers;  // ray_changes.h

class Tracer {
 public:
  Tracer(const Scene& scene, Isa isa);
  // Of `scene` after an edit: instances have other places, shapes or materials than in `before`.
  // `moved`, by instance: true for all that are elsewhere, or of another shape, than in the scene
  // that was read, and at least for those of `before`. The scene of the first Tracer must outlive
  // all that come from it.
  Tracer(const Tracer& before, const Scene& scene, const std::vector<bool>& moved);
  // Of the same scene, for rays that do not see the instances of which `hidden` is true.
  Tracer(const Tracer& all, const std::vector<bool>& hidden);
  ~Tracer();
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  // Closest hit of origin + t * direction, t in [0, tFar]; Hit::none() if there is none. direction
  // need not be unit.
  Hit closest(Vec3 origin, Vec3 direction, float tFar) const;
  // Closest hits of the lanes in `active` (bit i = lane i); hits[lane] of other lanes stays as it
  // is. `coherent`: the rays start together and go the same way.
  void closest16(RayPacket& rays, uint32_t active, Hit* hits, bool coherent = true) const;

  // True if anything blocks that ray.
  bool occluded(Vec3 origin, Vec3 direction, float tFar) const;
  // Bits of the active lanes whose segment is blocked. `coherent`: the rays share an end or are
  // parallel.
  uint32_t occluded16(RayPacket& rays, uint32_t active, bool coherent = true) const;

  // The surface at a hit, in world space, with its error bound.
  SurfacePoint surface(const Hit& hit) const;

  // p, moved off the surfaces that lie within rounding of it, so that rays may start there. It
  // stays on its side. From exactly in a surface it goes to where `direction` goes, or to the front
  // if `direction` is along the surface.
  Vec3 clearOf(Vec3 p, Vec3 direction) const;

  // World-space corners of an instance's triangle in the mesh's order, as barycentrics count them.
  // The front sees them counterclockwise, or clockwise if the instance is mirrored: see surface().
  struct Corners {
    Vec3 a, b, c;
  };
  Corners corners(uint32_t instance, uint32_t triangle) const;
  // Unit geometric normal of the triangle's front; 0 for one without area.
  Vec3 frontNormal(uint32_t instance, uint32_t triangle) const;

  // Keeps every ray in `log` until called with null. For measurements, with one tracing thread.
  void logTo(RayLog* log) { log_ = log; }

  // What decides about the answers of single rays, to be compared with that of other edits.
  std::shared_ptr<const RayAnswers> answers() const;

  const Scene& scene() const;
  const std::string& isaName() const;  // "avx2" or "avx512": what runs, part of the pixel class

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  RayLog* log_ = nullptr;
};

}  // namespace ninefold
