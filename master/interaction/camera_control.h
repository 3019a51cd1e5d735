// camera_control.h: the camera that a person moves: events and time in, camera out. Pure.
//
//   fly     keys are held: eye = anchor + velocity * time held; nothing coasts when they are let go
//   look    the eye turns in place (yaw about the world's up, pitch up to kMaxPitch)
//   orbit   the eye turns about the pivot, which keeps its place in the picture
//   pan     eye and pivot slide along the picture's plane
//   dolly   the eye moves towards the pivot and never reaches it
//
// An orthographic camera shows nothing larger from nearby: dolly and frame change the height of
// what it shows instead.
//
// Frame-rate independent to the bit: the time for which keys are held is summed in whole
// nanoseconds since the last event, so that any splitting of it gives the same camera.
//
// Threads: plain value. Errors: none; steps that are not finite are ignored.
// Proved: tests/master/camera_control_test.cpp.
#pragma once

#include <array>
#include <cstdint>

#include "common/base/clock.h"
#include "common/math/bounds.h"
#include "common/math/camera.h"

namespace ninefold {

enum class FlyKey : uint8_t { forward, back, left, right, up, down };

class CameraControl {
 public:
  static constexpr double kMaxPitch = 1.55;     // [rad], short of straight up and down
  static constexpr double kSpeedStep = 1.25;    // a notch of the wheel
  static constexpr double kHurry = 4;           // speed with the hurry key
  static constexpr float kNarrowest = 0.0175f;  // vertical field of view [rad]
  static constexpr float kWidest = 2.6f;

  // `scene`: sets the first speed and the first pivot.
  CameraControl(const Camera& home, const Bounds& scene);

  void advance(Duration time);

  void hold(FlyKey key, bool down);
  void hurry(bool on);
  void releaseAll();  // the window lost the keyboard
  void changeSpeed(double notches);

  // Angles [rad]: right and up are positive.
  void look(double right, double up);
  void orbit(double right, double up);
  // Distances in picture heights at the pivot's distance: what is under the pointer follows it.
  void pan(double right, double up);
  void dolly(double notches);

  void setPivot(Vec3 pivot);         // stays where it is in the picture
  void frame(const Bounds& things);  // moves back or forth until they fill the view
  void go(const Camera& camera);     // one of the scene's, or any
  void reset() { go(home_); }
  void setVerticalFov(float radians);
  void setOrthographicHeight(float metres);  // of an orthographic camera

  Camera camera() const;
  Vec3 pivot() const { return Vec3(pivot_); }
  double speed() const { return speed_; }  // [m/s]
  bool isFlying() const { return velocity() != DVec3(0); }

 private:
  DVec3 velocity() const;
  DVec3 right() const;
  double pivotDistance() const;
  double heightAtPivot() const;  // of what the picture shows there [m]
  void settle();                 // time up to now goes into the anchor
  void turn(double right, double up);

  Camera home_;
  double sceneRadius_;
  DVec3 anchor_{0};  // the eye at the last event
  Duration held_{0};
  DVec3 forward_{0, 0, -1}, up_{0, 1, 0};
  float verticalFov_ = 0.8f;
  float orthographicHeight_ = 0;  // 0: a pinhole
  DVec3 pivot_{0};
  double speed_ = 1;
  bool hurry_ = false;
  std::array<bool, 6> keys_{};
};

}  // namespace ninefold
