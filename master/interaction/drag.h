// drag.h: from where the pointer is to where a thing goes: motions bound to a plane or an axis
// through the point that was grabbed. Pure.
//
//   ground              in the horizontal plane through the grabbed point
//   vertical, alongY    up and down        alongX, alongZ    along that axis
//   turn                about the vertical through `centre`: kTurn radians for a picture's height
//
// The grabbed point follows the pointer as far as the bound allows. A pointer's ray that meets the
// plane behind the eye, or almost along it, leaves the motion as it was.
// Threads: plain value.   Errors: none.   Proved: tests/master/drag_test.cpp.
#pragma once

#include "common/math/camera.h"

namespace ninefold {

enum class DragMode : uint8_t { ground, vertical, alongX, alongY, alongZ, turn };

class Drag {
 public:
  static constexpr double kTurn = 3.0;  // [rad]

  // `grabbed`, `centre`: in world space [m]. `pointer`: in pixels of the picture, from its upper
  // left corner. `before`: the thing's motion when it was grabbed.
  Drag(DragMode mode, Vec3 grabbed, Vec3 centre, Vec2 pointer, const DMat4& before)
      : mode_(mode),
        grabbed_(grabbed),
        centre_(centre),
        start_(pointer),
        before_(before),
        now_(before) {}

  DragMode mode() const { return mode_; }
  const DMat4& moveTo(Vec2 pointer, const Camera& camera, int width, int height);
  // The point under the pointer now.
  Vec3 point() const { return Vec3(grabbed_ + step_); }

 private:
  DragMode mode_;
  DVec3 grabbed_, centre_;
  Vec2 start_;
  DMat4 before_, now_;
  DVec3 step_{0};
};

// A turn about the vertical through a point, counterclockwise from above.
DMat4 turnAbout(DVec3 centre, double angle);
DMat4 shift(DVec3 by);

}  // namespace ninefold
