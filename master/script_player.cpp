#include "master/script_player.h"

#include <algorithm>
#include <utility>

#include "master/edit_history.h"

namespace ninefold {
namespace {

template <typename T>
void keepNew(const std::vector<T>& before, const std::vector<T>& now, std::vector<T>& changes) {
  for (const T& edit : now)
    if (std::ranges::find(before, edit) == before.end()) changes.push_back(edit);
}

}  // namespace

ScriptPlayer::Step ScriptPlayer::moveTo(double time) {
  const ScriptState before = std::exchange(shown_, script_.at(time, *scene_, start_));
  Step step;
  if (!(shown_.camera == before.camera)) step.camera = shown_.camera;
  SceneEdit now = EditHistory(scene_).valuesNow(before.edit);  // as they were read
  merge(now, shown_.edit);
  keepNew(before.edit.objects, now.objects, step.edit.objects);
  keepNew(before.edit.lights, now.lights, step.edit.lights);
  keepNew(before.edit.materials, now.materials, step.edit.materials);
  checkEdit(*scene_, step.edit);
  return step;
}

std::optional<Script> scriptOf(const Options& options, const Scene& scene) {
  if (options.script) return readScript(*options.script, scene);
  if (!options.animate) return std::nullopt;
  return playedAnimation(*options.animate, static_cast<int>(*options.stop.frames), scene);
}

}  // namespace ninefold
