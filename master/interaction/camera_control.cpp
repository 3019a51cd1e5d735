#include "master/interaction/camera_control.h"

namespace ninefold {
namespace {

constexpr DVec3 kUp(0, 1, 0);
constexpr double kSecondsAcross = 4;  // at first speed, for the radius of the scene
constexpr double kDollyStep = 0.9;    // of the distance to the pivot that is left after a notch
constexpr double kSmallest = 1e-6;  // of the scene's radius: nearest that an eye may be to a pivot

bool isFinite(double a, double b) { return std::isfinite(a) && std::isfinite(b); }

bool isSameView(Camera a, const Camera& b) {
  a.name = b.name;
  return a == b;
}

}  // namespace

CameraControl::CameraControl(const Camera& home, const Bounds& scene)
    : home_(home), sceneRadius_(std::max(1e-6, double(scene.radius()))) {
  speed_ = sceneRadius_ / kSecondsAcross;
  pivot_ = DVec3(scene.empty() ? Vec3(0) : scene.centre());
  go(home);
}

void CameraControl::advance(Duration time) { held_ += time; }

void CameraControl::settle() {
  anchor_ += velocity() * seconds(held_);
  held_ = Duration{0};
}

void CameraControl::hold(FlyKey key, bool down) {
  settle();
  keys_[static_cast<size_t>(key)] = down;
}

void CameraControl::hurry(bool on) {
  settle();
  hurry_ = on;
}

void CameraControl::releaseAll() {
  settle();
  keys_ = {};
  hurry_ = false;
}

void CameraControl::changeSpeed(double notches) {
  if (!std::isfinite(notches)) return;
  settle();
  speed_ =
      std::clamp(speed_ * std::pow(kSpeedStep, notches), 1e-4 * sceneRadius_, 10 * sceneRadius_);
}

DVec3 CameraControl::right() const { return glm::normalize(glm::cross(forward_, up_)); }

DVec3 CameraControl::velocity() const {
  const auto axis = [this](FlyKey plus, FlyKey minus) {
    return double(keys_[static_cast<size_t>(plus)]) - double(keys_[static_cast<size_t>(minus)]);
  };
  const DVec3 way = axis(FlyKey::forward, FlyKey::back) * forward_ +
                    axis(FlyKey::right, FlyKey::left) * right() +
                    axis(FlyKey::up, FlyKey::down) * kUp;
  const double length = glm::length(way);
  return length > 1e-9 ? speed_ * (hurry_ ? kHurry : 1) / length * way : DVec3(0);
}

// The new direction keeps the horizon level, whatever the camera's up was.
void CameraControl::turn(double right, double up) {
  // Straight up or down the heading is told by where the picture's up points.
  const bool steep = std::hypot(forward_.x, forward_.z) < 1e-4;
  const DVec3 heading = steep ? (forward_.y > 0 ? -up_ : up_) : forward_;
  const double yaw = std::atan2(heading.x, -heading.z) + right;
  const double now = std::atan2(forward_.y, std::hypot(forward_.x, forward_.z));
  const double pitch = std::clamp(now + up, -kMaxPitch, kMaxPitch);
  forward_ =
      DVec3(std::cos(pitch) * std::sin(yaw), std::sin(pitch), -std::cos(pitch) * std::cos(yaw));
  up_ = kUp;
}

void CameraControl::look(double right, double up) {
  if (!isFinite(right, up)) return;
  settle();
  turn(right, up);
}

// The pivot's place relative to the eye, in the camera's own axes, is what stays.
void CameraControl::orbit(double right, double up) {
  if (!isFinite(right, up)) return;
  settle();
  const DVec3 arm = pivot_ - anchor_, across = this->right();
  const DVec3 local(glm::dot(arm, across), glm::dot(arm, glm::cross(across, forward_)),
                    glm::dot(arm, forward_));
  turn(-right, -up);
  const DVec3 newAcross = this->right();
  anchor_ = pivot_ -
            (local.x * newAcross + local.y * glm::cross(newAcross, forward_) + local.z * forward_);
}

double CameraControl::pivotDistance() const {
  return std::max(glm::length(pivot_ - anchor_), kSmallest * sceneRadius_);
}

double CameraControl::heightAtPivot() const {
  if (orthographicHeight_ > 0) return double(orthographicHeight_);
  return 2 * std::tan(0.5 * double(verticalFov_)) * pivotDistance();
}

void CameraControl::pan(double right, double up) {
  if (!isFinite(right, up)) return;
  settle();
  const DVec3 across = this->right();
  const DVec3 step = -heightAtPivot() * (right * across + up * glm::cross(across, forward_));
  anchor_ += step;
  pivot_ += step;
}

void CameraControl::dolly(double notches) {
  if (!std::isfinite(notches)) return;
  settle();
  const double share = std::pow(kDollyStep, std::clamp(notches, -100.0, 100.0));
  if (orthographicHeight_ > 0)
    return setOrthographicHeight(static_cast<float>(share * double(orthographicHeight_)));
  const DVec3 arm = anchor_ - pivot_;
  const double length = glm::length(arm);
  const double wanted = std::clamp(share * length, kSmallest * sceneRadius_, 100 * sceneRadius_);
  anchor_ = length > 0 ? pivot_ + wanted / length * arm : pivot_ - wanted * forward_;
}

void CameraControl::setPivot(Vec3 pivot) {
  if (ninefold::isFinite(pivot)) pivot_ = DVec3(pivot);
}

void CameraControl::frame(const Bounds& things) {
  if (things.empty()) return;
  settle();
  pivot_ = DVec3(things.centre());
  const double radius = std::max(double(things.radius()), kSmallest * sceneRadius_);
  const double away = orthographicHeight_ > 0
                          ? std::max(glm::dot(pivot_ - anchor_, forward_), radius)
                          : radius / std::sin(0.5 * double(verticalFov_));
  anchor_ = pivot_ - away * forward_;
  setOrthographicHeight(static_cast<float>(2 * radius));
}

void CameraControl::go(const Camera& camera) {
  settle();
  if (!isSameView(camera, this->camera())) {  // to the bit, else a picture at rest would begin anew
    anchor_ = DVec3(camera.eye);
    forward_ = glm::normalize(DVec3(camera.forward));
    up_ = DVec3(camera.up);
    verticalFov_ = camera.verticalFov;
    orthographicHeight_ = camera.orthographicHeight;
  }
  // The pivot comes onto the line of sight, as far away as it was deep.
  const double depth = glm::dot(pivot_ - anchor_, forward_);
  pivot_ = anchor_ + std::max(depth, 0.1 * sceneRadius_) * forward_;
}

void CameraControl::setVerticalFov(float radians) {
  if (std::isfinite(radians)) verticalFov_ = std::clamp(radians, kNarrowest, kWidest);
}

void CameraControl::setOrthographicHeight(float metres) {
  if (orthographicHeight_ == 0 || !std::isfinite(metres)) return;
  const auto radius = static_cast<float>(sceneRadius_);
  orthographicHeight_ = std::clamp(metres, 1e-6f * radius, std::min(100 * radius, kLargestFilm));
}

Camera CameraControl::camera() const {
  Camera camera;
  camera.eye = Vec3(anchor_ + velocity() * seconds(held_));
  camera.forward = Vec3(forward_);
  camera.up = Vec3(up_);
  camera.verticalFov = verticalFov_;
  camera.orthographicHeight = orthographicHeight_;
  return camera;
}

}  // namespace ninefold
