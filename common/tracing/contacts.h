// contacts.h: surfaces that lie in one another, of which at least one lets light pass or sends it
// out: a glass that stands on a table, water in a glass, a lamp in the plane of the ceiling.
// Private to this folder.
//
// A ray meets one of them, whichever rounding puts first, and the next ray starts beyond both
// (surface.h). So at the hit all of them must be known:
//   which()   moves the hit to the one that lets least pass: opaque before solid before thin or
//             blended; then one that emits towards the ray, then one that shows it its front, then
//             the first in the scene
//   addTo()   names the solids at a point, so that all are left and entered together, and widens
//             the point's error so that new rays start outside all of them
// Two triangles are in contact at a point if both hold it and their planes there are no further
// apart than the sum of their errors (math/rounding.h). Triangles of one instance must also look in
// opposite directions.
//
// Triangles that touch any are found at load; a hit on another one costs a look-up. After an edit
// only the neighbourhood of what moved is looked at anew.
//
// Proved:  tests/tracing/contacts_test.cpp, tests/gi/glass_test.cpp.
// Owner:   refers to its arguments.   Threads: const after construction.
// Errors:  none; of more than SurfacePoint::kMaxContacts solids at a point the rest is forgotten.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "common/tracing/packet.h"
#include "common/tracing/part.h"

namespace ninefold {

class Contacts {
 public:
  // `parts` hold all geometries, are committed, and number their triangles as the geometries do.
  // `hidden`, by instance: touches nothing. `before`: of the same scene before an edit, or null.
  Contacts(const Scene& scene, const Geometries& geometries, const std::vector<AlphaMask>& masks,
           const Hierarchies& parts, const MaskBits& bits, const std::vector<bool>& hidden,
           const Contacts* before);

  Hit which(const Hit& hit, Vec3 direction) const {
    return touches(hit) ? foremost(hit, direction) : hit;
  }
  void addTo(const Hit& hit, SurfacePoint& p) const {
    if (touches(hit)) addSolids(hit, p);
  }
  // See Tracer::clearOf.
  Vec3 clearOf(Vec3 p, Vec3 direction) const;

  // How near a surface must come to another one to matter at its hits [m].
  Metres margin() const { return margin_; }
  // [instance][triangle]: whether it touches any; empty where nothing touches.
  const std::vector<std::vector<bool>>& touching() const { return touching_; }
  // What which() goes by first, of an instance.
  uint8_t rankOf(uint32_t instance) const;

 private:
  // A triangle with its plane.
  struct Face {
    uint32_t instance, triangle;
    Tracer::Corners at;
    Vec3 normal;  // of the front, unit; 0 for a triangle without area
  };
  struct Contact {
    uint32_t instance, triangle;
    float u, v;
    bool sameSide;
    float reach;  // distance of its plane and error there [m]
  };

  bool touches(const Hit& hit) const {
    return !touching_[hit.instance].empty() && touching_[hit.instance][hit.triangle];
  }
  using Mark = std::pair<uint32_t, uint32_t>;        // (instance, triangle)
  using Marks = std::vector<std::pair<Mark, Mark>>;  // that touch each other

  bool isNear(uint32_t instance, const std::vector<Bounds>& changed) const;
  std::vector<Bounds> changedSince(const Contacts& before) const;
  Marks findFrom(uint32_t instance) const;
  void mark(const Mark& mark);
  Hit foremost(const Hit& hit, Vec3 direction) const;
  void addSolids(const Hit& hit, SurfacePoint& p) const;
  std::vector<Contact> at(const Hit& hit, Vec3 position) const;
  Face face(uint32_t instance, uint32_t triangle) const;
  const Material& material(uint32_t instance) const;
  template <typename Visit>
  void forEachNear(Vec3 p, float radius, Visit visit) const;

  const Scene* scene_;
  const Geometries geometries_;
  const std::vector<AlphaMask>* masks_;
  const Hierarchies parts_;
  const MaskBits* bits_;
  float margin_;  // larger than any two errors [m]
  // By instance: what is in contact with it; or null.
  std::vector<std::shared_ptr<const Marks>> from_;
  std::vector<std::vector<bool>> touching_;  // [instance][triangle]; empty where nothing touches
};

}  // namespace ninefold
