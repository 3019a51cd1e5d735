// editor.h: what a person does to the scene: selects a thing, drags it, switches a lamp, turns the
// panel's numbers, takes it back. Each change goes to the run as a small edit and into the history.
//
// Places are shares of the picture's width and height, from its upper left corner. A pick in motion
// waits for a picture that knows what is where.
// Threads: the main thread.   Owner: the session; refers to the scene, the run and the camera.
// Errors: an edit that the scene cannot take is told in one line and left out.
#pragma once

#include <memory>
#include <optional>

#include "master/interaction/camera_control.h"
#include "master/interaction/edit_history.h"
#include "master/interaction/window_input.h"
#include "master/running/live_run.h"
#include "master/session/panel_values.h"

namespace ninefold {

class Editor {
 public:
  Editor(std::shared_ptr<const Scene> scene, LiveRun& live, CameraControl& camera)
      : scene_(std::move(scene)), live_(live), camera_(camera), history_(scene_) {}

  void pick(Vec2 place, const Shown& shown);
  void look(const Shown& shown);  // a new picture
  void selectLight(uint32_t light);
  void deselect();
  const std::optional<Selection>& selection() const { return selection_; }
  Bounds boundsOfSelection() const;  // empty without one

  void beginDrag(DragMode mode, Vec2 place, const Shown& shown);
  void drag(Vec2 place);
  void endDrag() { drag_.reset(); }

  void toggleLamp();
  void undo() { step(history_.undo()); }
  void redo() { step(history_.redo()); }
  void take(const PanelChanges& changes);    // of material, light and history
  void follow(const SceneEdit& scriptStep);  // a script's edit
  void tell(PanelView& view) const;

  Scene scene() const { return edited(*scene_, history_.all()); }
  bool isSaved() const { return saved_ == history_.revision(); }
  void setSaved() { saved_ = history_.revision(), ++action_; }

 private:
  void select(uint32_t instance);
  void edit(const SceneEdit& edit);
  void step(const std::optional<SceneEdit>& edit);

  std::shared_ptr<const Scene> scene_;  // as read
  LiveRun& live_;
  CameraControl& camera_;
  EditHistory history_;
  std::optional<Vec2> pick_;  // place that waits for a picture with objects
  std::optional<Selection> selection_;
  std::optional<Drag> drag_;
  uint64_t action_ = 1;  // of the history
  uint64_t saved_ = 0;   // revision of the history
};

}  // namespace ninefold
