#include "common/scene/replay_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include "common/scene/camera_choice.h"
#include "common/scene/settings_table.h"

namespace ninefold {
namespace {

// " --NAME VALUE", if the setting has a flag of its own.
template <typename T>
std::string flagOf(const Scene&, const Setting<T>& row, const T& value) {
  return row.value == nullptr ? "" : fmt::format(" --{} {}", row.name, textOf(value));
}

std::string flagOf(const Scene&, const Setting<Camera>&, const Camera&) { return ""; }

std::string flagOf(const Scene& scene, const Setting<Radiance>& row, const Radiance& value) {
  if (scene.environmentMap) {
    const std::string& name = scene.environmentMap->picture().name;
    return name.empty() ? "" : " " + name;
  }
  return fmt::format(" --{} {}", row.name, textOf(value));
}

// A camera of the scene by its number: that is exact.
std::string cameraOf(const Scene& scene, const Camera& camera) {
  const auto found = std::ranges::find(scene.cameras, camera);
  if (found == scene.cameras.end()) return specOf(scene, camera);
  return std::to_string(found - scene.cameras.begin());
}

std::string lightCamerasOf(const Scene& scene, const FrameKey& frame) {
  std::string all;
  for (const Camera& camera : frame.lightCameras)
    all += (all.empty() ? " --light-cameras " : "/") + cameraOf(scene, camera);
  return all;
}

}  // namespace

std::string replayLine(const Scene& scene, const Settings& s, const FrameKey& frame, int tile,
                       int phase) {
  std::string line = fmt::format(
      "ninefold-replay-task SCENE --frame {}:{}:{}:{:.9g} --tile {} --phase {} --size {}x{} "
      "--camera {}{}{}",
      frame.frame, frame.randomization, frame.rotation, frame.photonRadius, tile, phase, s.width,
      s.height, cameraOf(scene, s.camera), lightCamerasOf(scene, frame),
      s.compensate ? "" : " --preset paper");
  forEachSetting([&](const auto& row) {
    if (row.isUsedBy(s.method)) line += flagOf(scene, row, s.*row.member);
  });
  if (!scene.photonInstances.empty() && factsOf(s.method).has(kMapPhotons))
    line += " --photon-scene FILE";
  return line;
}

}  // namespace ninefold
