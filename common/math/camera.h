// camera.h: the pinhole camera, and the orthographic one, whose rays are parallel. Image x grows to
// the right, y downwards; pixel (0,0) is top left.
//
// A ray through film position (px, py), relative to the eye, with f the forward axis and v(px, py)
// linear in px and py:
//
//   pinhole        start 0                 place at depth z:  z v(px, py)       v . f = 1
//   orthographic   start v(px, py)         place at depth z:  v(px, py) + z f   v . f = 0
//
// An orthographic camera sees what lies in front of the plane through its eye.
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
  float verticalFov = 0.8f;      // full angle [rad], in (0, pi); of a pinhole
  float orthographicHeight = 0;  // of what the picture shows [m]; 0: a pinhole

  bool operator==(const Camera&) const = default;
};

inline constexpr float kLargestFilm = 1e9f;  // height of an orthographic camera's picture [m]

inline bool isOrthographic(const Camera& camera) { return camera.orthographicHeight > 0; }

// Maps film positions to rays for one camera and image size.
// Threads: const after construction.
class CameraRays {
 public:
  CameraRays() = default;
  CameraRays(const Camera& camera, int width, int height)
      : isParallel_(isOrthographic(camera)), forward_(camera.forward) {
    const float halfHeight =
        isParallel_ ? 0.5f * camera.orthographicHeight : std::tan(0.5f * camera.verticalFov);
    const float aspect = static_cast<float>(width) / static_cast<float>(height);
    const Vec3 right = glm::normalize(glm::cross(camera.forward, camera.up));
    const Vec3 upward = glm::cross(right, camera.forward);
    const float pixel = 2.0f * halfHeight / static_cast<float>(height);
    const Vec3 middle = isParallel_ ? Vec3(0) : camera.forward;
    corner_ = middle - halfHeight * aspect * right + halfHeight * upward;
    stepX_ = pixel * right;
    stepY_ = -pixel * upward;
  }
  // Film positions (px, py) are in pixels; a pixel's centre is at +0.5.
  // Where the ray starts, from the eye [m].
  Vec3 start(float px, float py) const { return isParallel_ ? onFilm(px, py) : Vec3(0); }
  // Unit direction of the ray.
  Vec3 direction(float px, float py) const {
    return isParallel_ ? forward_ : glm::normalize(onFilm(px, py));
  }
  // The ray's place at a depth [m] along forward, from the eye [m].
  Vec3 atDepth(float px, float py, float depth) const {
    return isParallel_ ? onFilm(px, py) + depth * forward_ : depth * onFilm(px, py);
  }
  // Depth along forward of what is `distance` away along the ray [m].
  float depthOf(float px, float py, float distance) const {
    return isParallel_ ? distance : distance / glm::length(onFilm(px, py));
  }
  // Film position [pixels] of the ray that meets d, from the eye; nothing if d is not in front.
  std::optional<Vec2> filmPosition(Vec3 d) const {
    const float depth = glm::dot(d, forward_);
    if (!(depth > 0)) return std::nullopt;
    const Vec3 across = (isParallel_ ? d : d / depth) - corner_;
    return Vec2(glm::dot(across, stepX_) / glm::dot(stepX_, stepX_),
                glm::dot(across, stepY_) / glm::dot(stepY_, stepY_));
  }

 private:
  // v(px, py)
  Vec3 onFilm(float px, float py) const { return corner_ + px * stepX_ + py * stepY_; }

  bool isParallel_ = false;
  Vec3 forward_{0}, corner_{0}, stepX_{0}, stepY_{0};
};

}  // namespace ninefold
