#include "master/running/script_player.h"

#include <utility>

#include "master/interaction/edit_history.h"

namespace ninefold {
namespace {

// Both lists name each thing once, in ascending order.
template <typename T, typename Key>
void keepNew(const std::vector<T>& before, const std::vector<T>& now, Key T::*key,
             std::vector<T>& changes) {
  auto old = before.begin();
  for (const T& edit : now) {
    while (old != before.end() && *old.*key < edit.*key) ++old;
    if (old == before.end() || !(*old == edit)) changes.push_back(edit);
  }
}

}  // namespace

ScriptPlayer::Step ScriptPlayer::moveTo(double time) {
  const ScriptState before = std::exchange(shown_, script_.at(time, *scene_, start_));
  Step step;
  if (!(shown_.camera == before.camera)) step.camera = shown_.camera;
  SceneEdit now = EditHistory(scene_).valuesNow(before.edit);  // as they were read
  merge(now, shown_.edit);
  keepNew(before.edit.objects, now.objects, &ObjectEdit::node, step.edit.objects);
  keepNew(before.edit.lights, now.lights, &LightEdit::light, step.edit.lights);
  keepNew(before.edit.materials, now.materials, &MaterialEdit::material, step.edit.materials);
  keepNew(before.edit.shapes, now.shapes, &ShapeEdit::where, step.edit.shapes);
  checkEdit(*scene_, now);
  return step;
}

std::optional<Script> scriptOf(const Options& options, const Scene& scene) {
  if (options.script) return readScript(*options.script, scene);
  if (!options.animate) return std::nullopt;
  return playedAnimation(*options.animate, static_cast<int>(*options.stop.frames), scene);
}

}  // namespace ninefold
