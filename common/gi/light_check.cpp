#include "common/gi/light_check.h"

#include <fmt/format.h>

#include "common/base/error.h"
#include "common/scene/replay_line.h"

namespace ninefold {
namespace {

// What was found, if anything: "E of the diffuse layer is (nan, 0, 0) at pixel 3".
std::string oddPixel(const char* name, const RgbPlane& plane) {
  for (size_t i = 0; i < plane.r.size(); ++i) {
    const Vec3 value(plane.r[i], plane.g[i], plane.b[i]);
    if (!isFinite(value))
      return fmt::format("{} is ({}, {}, {}) at the task's pixel {}", name, value.x, value.y,
                         value.z, i);
  }
  return {};
}

std::string oddPlane(const TileResult& tile) {
  constexpr std::array kLayerNames{"diffuse", "reflection", "transmission"};
  for (size_t layer = 0; layer < kLayers; ++layer) {
    const LayerPlanes& p = tile.layers[layer];
    for (const auto& [name, plane] : {std::pair("E", &p.irradiance),
                                      {"U", &p.unfiltered},
                                      {"reflectance", &p.reflectance},
                                      {"normal", &p.normal}})
      if (const std::string odd = oddPixel(name, *plane); !odd.empty())
        return fmt::format("{} layer: {}", kLayerNames[layer], odd);
  }
  const ExtraPlanes& e = tile.extras;
  for (const auto& [name, plane] :
       {std::pair("albedo", &e.albedo), {"first normal", &e.normal}, {"caustic E", &e.caustic}})
    if (const std::string odd = oddPixel(name, *plane); !odd.empty()) return odd;
  return {};
}

void checkNone(const std::string& odd, const std::string& where, const Scene& scene,
               const Settings& settings, const Task& task) {
  if (odd.empty()) return;
  const std::string line =
      fmt::format("that light is a number ({}, {}; {})", odd, where,
                  replayLine(scene, settings, task.frame, task.tile, task.phase));
  checkFailed(line.c_str(), {}, __FILE__, __LINE__);
}

}  // namespace

void checkLight(const TileResult& tile, const Task& task, const Scene& scene,
                const Settings& settings) {
  checkNone(oddPlane(tile),
            fmt::format("frame {}, tile {}, phase {}", task.frame.frame, task.tile, task.phase),
            scene, settings, task);
}

void checkLight(const FrameLight& light, const FrameKey& frame, int set, const Scene& scene,
                const Settings& settings) {
  // Any task of the set makes it again.
  Task task{.frame = frame};
  const int sets = settings.interleave.sets();
  while (task.phase + 1 < sets && lightSetOfPhase(task.phase, frame.rotation, sets) != set)
    ++task.phase;
  checkNone(light.oddValue(), fmt::format("frame {}, set {}", frame.frame, set), scene, settings,
            task);
}

}  // namespace ninefold
