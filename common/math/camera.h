// camera.h: the pinhole camera. Image x grows to the right and y downwards; pixel (0,0) is top left.
#pragma once

#include <string>

#include "common/math/vec.h"

namespace ninefold {

struct Camera {
  std::string name;
  Vec3 eye{0, 0, 0};       // in scene coordinates, after recentring [m]
  Vec3 forward{0, 0, -1};  // unit
  Vec3 up{0, 1, 0};        // need not be unit or orthogonal to forward, must not be parallel to it
  float verticalFov = 0.8f;  // full angle [rad], in (0, pi)

  bool operator==(const Camera&) const = default;
};

// Maps film positions to ray directions for one camera and image size.
// Threads: const after construction.
class CameraRays {
 public:
  CameraRays(const Camera& camera, int width, int height) {
    const float halfHeight = std::tan(0.5f * camera.verticalFov);
    const float aspect = static_cast<float>(width) / static_cast<float>(height);
    const Vec3 right = glm::normalize(glm::cross(camera.forward, camera.up));
    const Vec3 upward = glm::cross(right, camera.forward);
    const float pixel = 2.0f * halfHeight / static_cast<float>(height);
    corner_ = camera.forward - halfHeight * aspect * right + halfHeight * upward;
    stepX_ = pixel * right;
    stepY_ = -pixel * upward;
  }
  // Unit direction through film position (px, py) in pixels; a pixel's centre is at +0.5.
  Vec3 direction(float px, float py) const {
    return glm::normalize(corner_ + px * stepX_ + py * stepY_);
  }

 private:
  Vec3 corner_, stepX_, stepY_;  // forward has length 1 on the image plane at distance 1
};

}  // namespace ninefold
