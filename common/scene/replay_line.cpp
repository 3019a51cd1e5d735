#include "common/scene/replay_line.h"

#include <fmt/format.h>

#include "common/scene/camera_choice.h"
#include "common/scene/settings_table.h"

namespace ninefold {
namespace {

// " --NAME VALUE", if the setting has a flag of its own.
template <typename T>
std::string flagOf(const Setting<T>& row, const T& value) {
  return row.value == nullptr ? "" : fmt::format(" --{} {}", row.name, textOf(value));
}

std::string flagOf(const Setting<Camera>&, const Camera&) { return ""; }

}  // namespace

std::string replayLine(const Scene& scene, const Settings& s, uint32_t frame) {
  std::string line = fmt::format(
      "ninefold-master SCENE --local-clients 1 --output again.exr --frames {} --size {}x{} "
      "--camera {}",
      uint64_t{frame} + 1, s.width, s.height, specOf(scene, s.camera));
  forEachSetting([&](const auto& row) {
    if (row.isUsedBy(s.method)) line += flagOf(row, s.*row.member);
  });
  return line;
}

}  // namespace ninefold
