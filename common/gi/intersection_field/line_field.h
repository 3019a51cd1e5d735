// line_field.h: where lines meet the scene: the local fields of all instances, linked on demand.
//
//   slice     lists the instances that it meets; the hits of one of its lines are those of their
//             pages, put together by t
//   next      the hit that follows a place on a line
//
// Hits nearer to that place than the grid's rounding count as being there: things that stand on
// each other do not hide each other.
//
// Instances that stayed in an edit keep their local fields, as long as the grid is the same.
//
// Source:  Ren et al. 2005, 4.3 (global field).   Proved: tests/gi/line_field_test.cpp.
// Threads: const after construction.   Owner: shares the scene's meshes.
// Errors:  none; field_size.h tells before how large it is.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "common/gi/intersection_field/local_field.h"

namespace ninefold {

// A line meets a triangle at t.
struct LineHit {
  uint32_t instance = 0, triangle = 0;
  float t = 0;
  bool operator==(const LineHit&) const = default;
};

class LineField {
 public:
  // `before`: of the scene before an edit, or null: it saves work alone.
  LineField(const LineGrid& grid, const Scene& scene, const LineField* before);

  const LineGrid& grid() const { return grid_; }
  size_t instances() const { return locals_.size(); }
  const LocalField& local(size_t instance) const { return *locals_[instance]; }
  bool isShared(const LineField& other, size_t instance) const {
    return instance < other.instances() && locals_[instance] == other.locals_[instance];
  }
  // Those that the line's slice meets, by rising number.
  std::span<const uint32_t> instancesAt(const GridLine& line) const;
  // All hits of a line, by rising t; among equals by instance and triangle.
  void hitsOf(const GridLine& line, std::vector<LineHit>& hits) const;
  // The nearest hit beyond t, or before it. Holes of masked materials are passed.
  std::optional<LineHit> next(const GridLine& line, float t, bool isForward) const;
  // Where on its triangle a hit is: barycentrics of the second and third corner.
  Vec2 placeOf(const GridLine& line, const LineHit& hit) const;

  size_t bytes() const;

 private:
  bool isHole(const GridLine& line, const LineHit& hit) const;

  Scene scene_;  // shares meshes and images
  LineGrid grid_;
  std::vector<std::shared_ptr<const LocalField>> locals_;
  std::vector<uint32_t> firstOfSlice_;  // into the next; and the end
  std::vector<uint32_t> instances_;
};

// Where point p of a plane lies in a triangle: barycentrics of b and c, clamped.
Vec2 barycentricsOf(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p);

}  // namespace ninefold
