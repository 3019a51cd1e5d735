// camera.h: the pinhole camera. Image x grows to the right, y downwards; pixel (0,0) is top left.
#pragma once

#include <optional>
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
  CameraRays() = default;
  CameraRays(const Camera& camera, int width, int height) : forward_(camera.forward) {
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
  Vec3 direction(float px, float py) const { return glm::normalize(onImagePlane(px, py)); }
  // From the eye to a film position (px, py) on the image plane, at distance 1 along forward.
  Vec3 onImagePlane(float px, float py) const { return corner_ + px * stepX_ + py * stepY_; }
  // Film position [pixels] where the ray along d arrives; nothing if d does not point forwards.
  std::optional<Vec2> filmPosition(Vec3 d) const {
    const float depth = glm::dot(d, forward_);
    if (!(depth > 0)) return std::nullopt;
    const Vec3 across = d / depth - corner_;
    return Vec2(glm::dot(across, stepX_) / glm::dot(stepX_, stepX_),
                glm::dot(across, stepY_) / glm::dot(stepY_, stepY_));
  }

 private:
  Vec3 forward_{0}, corner_{0}, stepX_{0}, stepY_{0};  // the image plane is at distance 1
};

}  // namespace ninefold
