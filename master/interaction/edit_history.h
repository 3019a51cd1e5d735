// edit_history.h: all edits of a session, with undo and redo. A pure value.
//
// An action is what one undo takes back: a whole drag, a turned slider. It has a number; edits with
// the same number are one action.
// Threads: plain value.   Errors: none.   Proved: tests/master/edit_history_test.cpp.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "common/scene/edit.h"

namespace ninefold {

class EditHistory {
 public:
  static constexpr size_t kMostActions = 1000;

  explicit EditHistory(std::shared_ptr<const Scene> asRead) : asRead_(std::move(asRead)) {}

  // Needs checkEdit(scene, edit).
  void apply(const SceneEdit& edit, uint64_t action);
  // By a script: no action of a person, undo passes over it.
  void follow(const SceneEdit& edit) { merge(all_, edit); }
  // What changes by it; nothing if there is nothing to take back, or to do again.
  std::optional<SceneEdit> undo();
  std::optional<SceneEdit> redo();

  // Of the scene as a person's actions left it: after undo and redo the number that it had.
  uint64_t revision() const { return done_.empty() ? forgotten_ : done_.back().number; }

  const SceneEdit& all() const { return all_; }  // merged, over the scene as it was read
  // The things that `like` names, as they are now.
  SceneEdit valuesNow(const SceneEdit& like) const;

 private:
  struct Action {
    uint64_t number;
    SceneEdit before, after;
  };
  std::optional<SceneEdit> move(std::vector<Action>& from, std::vector<Action>& to, bool back);

  std::shared_ptr<const Scene> asRead_;
  SceneEdit all_;
  std::vector<Action> done_, undone_;
  uint64_t forgotten_ = 0;  // the last action that cannot be undone any more
};

}  // namespace ninefold
