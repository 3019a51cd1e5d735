#include "common/scene/camera_choice.h"

#include <charconv>
#include <optional>

#include "common/base/error.h"

namespace ninefold {
namespace {

template <typename Number>
std::optional<Number> parse(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

// The part of `text` before the next `separator`, which is cut off; all of it if there is none.
std::string_view cut(std::string_view& text, char separator) {
  const size_t at = std::min(text.find(separator), text.size());
  const std::string_view part = text.substr(0, at);
  text.remove_prefix(std::min(at + 1, text.size()));
  return part;
}

std::optional<DVec3> parsePoint(std::string_view text) {
  DVec3 point;
  for (int c = 0; c < 3; ++c) {
    const auto number = parse<double>(cut(text, ','));
    if (!number || !std::isfinite(*number)) return {};
    point[c] = *number;
  }
  return text.empty() ? std::optional(point) : std::nullopt;
}

std::optional<Camera> parseSpec(const Scene& scene, std::string_view spec) {
  const auto eye = parsePoint(cut(spec, ':'));
  const auto target = parsePoint(cut(spec, ':'));
  const bool isHeight = spec.ends_with('m');
  if (isHeight) spec.remove_suffix(1);
  const auto size = parse<double>(spec);
  const double most = isHeight ? double{kLargestFilm} : std::nextafter(180.0, 0.0);
  if (!eye || !target || !size || !(*size > 0 && *size <= most)) return {};
  const DVec3 view = *target - *eye;
  const double distance = glm::length(view);
  if (!(distance > 0) || !std::isfinite(distance)) return {};
  Camera camera;
  camera.name = "command line";
  camera.eye = Vec3(*eye - scene.origin);
  camera.forward = Vec3(view / distance);
  const bool upright = std::hypot(camera.forward.x, camera.forward.z) > 1e-4f;
  camera.up = upright ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
  if (isHeight)
    camera.orthographicHeight = static_cast<float>(*size);
  else
    camera.verticalFov = static_cast<float>(*size) * kPi / 180;
  return camera;
}

std::string listOf(const std::vector<Camera>& cameras) {
  std::string list;
  for (size_t i = 0; i < cameras.size() && i < 20; ++i)
    list += (i > 0 ? ", " : "") + std::to_string(i) + " '" + cameras[i].name + "'";
  return list;
}

}  // namespace

Camera chooseCamera(const Scene& scene, std::string_view spec) {
  if (spec.empty()) return scene.cameras.front();
  for (const Camera& camera : scene.cameras)
    if (camera.name == spec) return camera;
  const auto index = parse<size_t>(spec);
  if (index && *index < scene.cameras.size()) return scene.cameras[*index];
  if (const auto camera = parseSpec(scene, spec)) return *camera;
  fail(
      "no camera '{}': the scene has {}; or give eye:target:fov as x,y,z:x,y,z:degrees (or :5m, "
      "orthographic, 5 m high)",
      spec, listOf(scene.cameras));
}

std::string specOf(const Scene& scene, const Camera& camera) {
  const DVec3 eye = DVec3(camera.eye) + scene.origin, target = eye + DVec3(camera.forward);
  const std::string size = isOrthographic(camera)
                               ? fmt::format("{:.6g}m", camera.orthographicHeight)
                               : fmt::format("{:.6g}", camera.verticalFov * 180 / kPi);
  return fmt::format("{:.9g},{:.9g},{:.9g}:{:.9g},{:.9g},{:.9g}:{}", eye.x, eye.y, eye.z, target.x,
                     target.y, target.z, size);
}

}  // namespace ninefold
