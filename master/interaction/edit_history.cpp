#include "master/interaction/edit_history.h"

#include <algorithm>

namespace ninefold {
namespace {

template <typename T, typename Key>
const T* find(const std::vector<T>& list, Key T::*key, Key value) {
  const auto found = std::ranges::find(list, value, key);
  return found == list.end() ? nullptr : &*found;
}

}  // namespace

SceneEdit EditHistory::valuesNow(const SceneEdit& like) const {
  SceneEdit now;
  for (const ObjectEdit& e : like.objects) {
    const ObjectEdit* known = find(all_.objects, &ObjectEdit::node, e.node);
    now.objects.push_back(known != nullptr ? *known : ObjectEdit{e.node, DMat4(1)});
  }
  for (const LightEdit& e : like.lights) {
    const LightEdit* known = find(all_.lights, &LightEdit::light, e.light);
    now.lights.push_back(known != nullptr ? *known : editOf(*asRead_, e.light));
  }
  for (const MaterialEdit& e : like.materials) {
    const MaterialEdit* known = find(all_.materials, &MaterialEdit::material, e.material);
    now.materials.push_back(known != nullptr ? *known : editOfMaterial(*asRead_, e.material));
  }
  for (const ShapeEdit& e : like.shapes) {
    const ShapeEdit* known = find(all_.shapes, &ShapeEdit::where, e.where);
    now.shapes.push_back(known != nullptr ? *known : editOfShape(*asRead_, e.where));
  }
  return now;
}

void EditHistory::apply(const SceneEdit& edit, uint64_t action) {
  undone_.clear();
  if (done_.empty() || done_.back().number != action) {
    done_.push_back({action, {}, {}});
    if (done_.size() > kMostActions) {
      forgotten_ = done_.front().number;
      done_.erase(done_.begin());
    }
  }
  // What the action touched before keeps the value that it had then.
  SceneEdit before = valuesNow(edit);
  merge(before, done_.back().before);
  done_.back().before = before;
  merge(done_.back().after, edit);
  merge(all_, edit);
}

std::optional<SceneEdit> EditHistory::move(std::vector<Action>& from, std::vector<Action>& to,
                                           bool back) {
  if (from.empty()) return std::nullopt;
  Action action = std::move(from.back());
  from.pop_back();
  const SceneEdit edit = back ? action.before : action.after;
  merge(all_, edit);
  to.push_back(std::move(action));
  return edit;
}

std::optional<SceneEdit> EditHistory::undo() { return move(done_, undone_, true); }
std::optional<SceneEdit> EditHistory::redo() { return move(undone_, done_, false); }

}  // namespace ninefold
