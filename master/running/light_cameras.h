// light_cameras.h: the cameras that the light of frames in motion is made for, where a method's
// light needs the view: those of the last eight frames. Pure.
//
// The first frame of a gesture has eight times its own camera. Each frame after it puts its own in
// place of the oldest one. So an eighth of the light's camera points change from frame to frame,
// also when the picture turns fast. All are in the frame's key: a client that comes late needs no
// more.
//
// Proved:  tests/master/live_plan_test.cpp.
// Threads: plain value.   Errors: none.
#pragma once

#include <vector>

#include "common/scene/settings.h"

namespace ninefold {

class LightCameras {
 public:
  // A gesture begins.
  void clear() { cameras_.clear(), next_ = 0; }

  // Those of the next frame, seen by `camera`.
  const std::vector<Camera>& next(Camera camera) {
    camera.name.clear();
    if (cameras_.empty()) cameras_.assign(kMostLightCameras, camera);
    cameras_[next_++ % kMostLightCameras] = camera;
    return cameras_;
  }

 private:
  std::vector<Camera> cameras_;  // each in its place for eight frames
  size_t next_ = 0;
};

}  // namespace ninefold
