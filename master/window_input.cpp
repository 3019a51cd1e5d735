#include "master/window_input.h"

#include <optional>
#include <utility>

namespace ninefold {
namespace {

constexpr float kLookPerHeight = 1.5f;   // [rad] for a pointer that crosses the picture's height
constexpr float kOrbitPerHeight = 3.0f;  // [rad]

std::optional<FlyKey> flyKeyOf(int key) {
  switch (key) {
    case 'W':
      return FlyKey::forward;
    case 'S':
      return FlyKey::back;
    case 'A':
      return FlyKey::left;
    case 'D':
      return FlyKey::right;
    case 'E':
      return FlyKey::up;
    case 'Q':
      return FlyKey::down;
    default:
      return std::nullopt;
  }
}

constexpr int kShiftLeft = 340, kShiftRight = 344;

bool isDigit(int key) { return key >= '0' && key <= '9'; }
bool isAxis(int key) { return key == 'X' || key == 'Y' || key == 'Z' || key == 'R'; }

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
        onButton(event);
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

void WindowInput::onKey(const WindowEvent& event, CameraControl& camera) {
  const bool down = event.kind == WindowEvent::Kind::keyDown;
  if (event.key == kShiftLeft || event.key == kShiftRight) camera.hurry(down);
  const bool typed = down && !event.modifiers.control;
  if (const auto fly = flyKeyOf(event.key)) camera.hold(*fly, typed);
  if (isAxis(event.key)) heldAxis_ = typed ? event.key : 0;
  if (down) onPress(event.key, event.modifiers, camera);
}

void WindowInput::onPress(int key, const Modifiers& modifiers, CameraControl&) {
  using Kind = Command::Kind;
  if (modifiers.control) {
    if (key == 'Z') say(modifiers.shift ? Kind::redo : Kind::undo);
    if (key == 'Y') say(Kind::redo);
    if (key == 'S') say(Kind::saveScene);
    if (key == 'Q') say(Kind::close);
    return;
  }
  if (isDigit(key))
    if (const auto view = viewOfKey(key - '0', modifiers.shift))
      commands_.push_back({Kind::view, pointer_, dragMode(modifiers_), 0, *view});
  switch (key) {
    case '[':
      return say(Kind::exposure, -kExposureStep);
    case ']':
      return say(Kind::exposure, kExposureStep);
    case 'F':
      return say(Kind::frameSelection);
    case 'C':
      return say(Kind::nextCamera);
    case 'L':
      return say(Kind::toggleLamp);
    case 'V':
      return say(Kind::saveView);
    case ' ':
      return say(Kind::togglePlay);
    case 'P':
      return say(Kind::savePicture);
    case key::kHome:
      return say(Kind::reset);
    case key::kTab:
      return say(Kind::togglePanel);
    case key::kEscape:
      return say(Kind::deselect);
    default:
      return;
  }
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

void WindowInput::onButton(const WindowEvent& event) {
  const bool down = event.kind == WindowEvent::Kind::buttonDown;
  pointer_ = event.pointer;
  modifiers_ = event.modifiers;
  if (event.button == Button::right) right_ = down;
  if (event.button == Button::middle) middle_ = down;
  if (event.button != Button::left) return;
  if (down) {
    pressedAt_ = pointer_;
  } else if (left_) {
    say(dragging_ ? Command::Kind::dragEnd : Command::Kind::select);
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
