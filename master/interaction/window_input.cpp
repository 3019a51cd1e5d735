#include "master/interaction/window_input.h"

#include <utility>

#include "master/interaction/window_keys.h"

namespace ninefold {
namespace {

constexpr float kLookPerHeight = 1.5f;   // [rad] for a pointer that crosses the picture's height
constexpr float kOrbitPerHeight = 3.0f;  // [rad]

constexpr int kShiftLeft = 340, kShiftRight = 344;

}  // namespace

void WindowInput::passTo(Time now, CameraControl& camera) {
  if (now > now_) camera.advance(now - std::exchange(now_, now));
}

std::vector<Command> WindowInput::take(const std::vector<WindowEvent>& events, float height,
                                       CameraControl& camera) {
  for (const WindowEvent& event : events) {
    passTo(event.time, camera);
    switch (event.kind) {
      case WindowEvent::Kind::keyDown:
      case WindowEvent::Kind::keyUp:
        onKey(event, camera);
        break;
      case WindowEvent::Kind::buttonDown:
      case WindowEvent::Kind::buttonUp:
        onButton(event, height, camera);
        break;
      case WindowEvent::Kind::move:
        onMove(event, height, camera);
        break;
      case WindowEvent::Kind::scroll:
        if (event.modifiers.control)
          camera.dolly(double(event.notches));
        else
          camera.changeSpeed(double(event.notches));
        break;
      case WindowEvent::Kind::focusLost:
        camera.releaseAll();
        heldAxis_ = 0;
        break;
    }
  }
  return std::exchange(commands_, {});
}

// What is held is let go whatever else is held by then.
void WindowInput::onKey(const WindowEvent& event, CameraControl& camera) {
  const bool down = event.kind == WindowEvent::Kind::keyDown;
  if (event.key == kShiftLeft || event.key == kShiftRight) camera.hurry(down);
  const WindowKey* held = meaningOf(event.key, {});
  const bool typed = down && !event.modifiers.control;
  if (held != nullptr && held->use == WindowKey::Use::fly) camera.hold(held->fly, typed);
  if (held != nullptr && held->use == WindowKey::Use::axis) heldAxis_ = typed ? event.key : 0;
  if (down) onPress(event.key, event.modifiers);
}

void WindowInput::onPress(int key, const Modifiers& modifiers) {
  const WindowKey* meaning = meaningOf(key, modifiers);
  if (meaning == nullptr) return;
  if (meaning->use == WindowKey::Use::command) say(meaning->command, meaning->amount);
  if (meaning->use != WindowKey::Use::view) return;
  if (const auto view = viewOfKey(key - '0', modifiers.shift))
    commands_.push_back({Command::Kind::view, pointer_, dragMode(modifiers_), 0, *view});
}

void WindowInput::say(Command::Kind kind, float amount) {
  commands_.push_back({kind, pointer_, dragMode(modifiers_), amount, {}});
}

DragMode WindowInput::dragMode(const Modifiers& modifiers) const {
  switch (heldAxis_) {
    case 'X':
      return DragMode::alongX;
    case 'Y':
      return DragMode::alongY;
    case 'Z':
      return DragMode::alongZ;
    case 'R':
      return DragMode::turn;
    default:
      return modifiers.control ? DragMode::vertical : DragMode::ground;
  }
}

void WindowInput::onButton(const WindowEvent& event, float height, CameraControl& camera) {
  const bool down = event.kind == WindowEvent::Kind::buttonDown;
  if (event.pointer != pointer_) onMove(event, height, camera);  // it may have come without a word
  modifiers_ = event.modifiers;
  if (event.button == Button::right) right_ = down;
  if (event.button == Button::middle) middle_ = down;
  if (event.button != Button::left) return;
  if (down) {
    pressedAt_ = pointer_;
  } else if (left_) {
    dragging_
        ? say(Command::Kind::dragEnd)
        : commands_.push_back({Command::Kind::select, pressedAt_, dragMode(modifiers_), 0, {}});
    dragging_ = false;
  }
  left_ = down;
}

void WindowInput::onMove(const WindowEvent& event, float height, CameraControl& camera) {
  const Vec2 step = (event.pointer - pointer_) / std::max(1.0f, height);
  pointer_ = event.pointer;
  if (right_) camera.look(double(step.x * kLookPerHeight), double(-step.y * kLookPerHeight));
  if (middle_ && modifiers_.shift) camera.pan(double(step.x), double(-step.y));
  if (middle_ && !modifiers_.shift)
    camera.orbit(double(step.x * kOrbitPerHeight), double(-step.y * kOrbitPerHeight));
  if (!left_) return;
  if (!dragging_ && glm::length(pointer_ - pressedAt_) >= kClick) {
    dragging_ = true;
    commands_.push_back({Command::Kind::dragBegin, pressedAt_, dragMode(modifiers_), 0, {}});
  }
  if (dragging_) say(Command::Kind::drag);
}

}  // namespace ninefold
