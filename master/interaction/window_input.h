// window_input.h: what keys and pointer mean: events go in; the camera moves, commands come out.
// Pure.
//
// window_keys.h says which key does what; the pointer's buttons:
//
//   right button       look around     middle button: orbit about the pivot; with Shift: pan
//   left button        a click selects, a drag moves what is selected
//   wheel              flying speed; with Control: towards the pivot
//
// A click or a drag begins where the button went down. How far the pointer was when it came up
// decides which of them it was.
//
// Threads: plain value.   Proved: tests/master/window_input_test.cpp.
#pragma once

#include <vector>

#include "master/assembly/view.h"
#include "master/interaction/camera_control.h"
#include "master/interaction/drag.h"
#include "master/interaction/window_events.h"

namespace ninefold {

struct Command {
  enum class Kind : uint8_t {
    select,     // what is at `pointer`
    dragBegin,  // of the selection, at `pointer`
    drag,       // to `pointer`
    dragEnd,
    view,      // `view`
    exposure,  // by `amount` [EV]
    frameSelection,
    reset,
    nextCamera,
    saveView,
    togglePlay,
    toggleLamp,
    deselect,
    undo,
    redo,
    saveScene,
    savePicture,
    togglePanel,
    toggleKeys,
    close,
  };
  Kind kind;
  Vec2 pointer{0};
  DragMode mode = DragMode::ground;
  float amount = 0;
  PictureView view = PictureView::beauty;
};

class WindowInput {
 public:
  static constexpr float kClick = 4;            // a drag begins when the pointer went that far
  static constexpr float kExposureStep = 0.5f;  // [EV]

  explicit WindowInput(Time now) : now_(now) {}

  // `height`: of the picture in the window.
  std::vector<Command> take(const std::vector<WindowEvent>& events, float height,
                            CameraControl& camera);
  // Time passes for keys that are held.
  void passTo(Time now, CameraControl& camera);

 private:
  void onKey(const WindowEvent& event, CameraControl& camera);
  void onPress(int key, const Modifiers& modifiers);
  void onButton(const WindowEvent& event, float height, CameraControl& camera);
  void onMove(const WindowEvent& event, float height, CameraControl& camera);
  DragMode dragMode(const Modifiers& modifiers) const;
  void say(Command::Kind kind, float amount = 0);

  Time now_;
  Vec2 pointer_{0}, pressedAt_{0};
  bool left_ = false, right_ = false, middle_ = false, dragging_ = false;
  Modifiers modifiers_;
  int heldAxis_ = 0;  // X, Y, Z or R
  std::vector<Command> commands_;
};

}  // namespace ninefold
