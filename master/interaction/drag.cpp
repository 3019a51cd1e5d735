#include "master/interaction/drag.h"

#include <optional>

namespace ninefold {
namespace {

constexpr double kSteep = 0.02;  // sine of a ray's angle to the plane or axis that it is to meet

std::optional<DVec3> onGround(DVec3 eye, DVec3 direction, DVec3 through) {
  if (std::abs(direction.y) < kSteep) return std::nullopt;
  const double t = (through.y - eye.y) / direction.y;
  if (t <= 0) return std::nullopt;
  return eye + t * direction;
}

// The point of the axis that is nearest to the ray.
std::optional<DVec3> onAxis(DVec3 eye, DVec3 direction, DVec3 through, DVec3 axis) {
  const double along = glm::dot(direction, axis), sine2 = 1 - along * along;
  if (sine2 < kSteep * kSteep) return std::nullopt;
  const DVec3 arm = through - eye;
  const double t = (along * glm::dot(arm, direction) - glm::dot(arm, axis)) / sine2;
  return through + t * axis;
}

}  // namespace

DMat4 shift(DVec3 by) {
  DMat4 m(1);
  m[3] = DVec4(by, 1);
  return m;
}

DMat4 turnAbout(DVec3 centre, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const DMat4 turn(DVec4(c, 0, -s, 0), DVec4(0, 1, 0, 0), DVec4(s, 0, c, 0), DVec4(0, 0, 0, 1));
  return shift(centre) * turn * shift(-centre);
}

const DMat4& Drag::moveTo(Vec2 pointer, const Camera& camera, int width, int height) {
  if (mode_ == DragMode::turn) {
    const double angle = kTurn * double(pointer.x - start_.x) / height;
    now_ = turnAbout(centre_, angle) * before_;
    return now_;
  }
  const CameraRays rays(camera, width, height);
  const DVec3 eye(camera.eye + rays.start(pointer.x, pointer.y));
  const DVec3 direction(rays.direction(pointer.x, pointer.y));
  std::optional<DVec3> point;
  switch (mode_) {
    case DragMode::ground:
      point = onGround(eye, direction, grabbed_);
      break;
    case DragMode::alongX:
      point = onAxis(eye, direction, grabbed_, DVec3(1, 0, 0));
      break;
    case DragMode::alongZ:
      point = onAxis(eye, direction, grabbed_, DVec3(0, 0, 1));
      break;
    default:
      point = onAxis(eye, direction, grabbed_, DVec3(0, 1, 0));
  }
  if (!point) return now_;
  step_ = *point - grabbed_;
  now_ = shift(step_) * before_;
  return now_;
}

}  // namespace ninefold
