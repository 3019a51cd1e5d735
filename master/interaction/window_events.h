// window_events.h: what a person did at the window, as plain values in the order of time.
#pragma once

#include <cstdint>

#include "common/base/clock.h"
#include "common/math/vec.h"

namespace ninefold {

enum class Button : uint8_t { left, right, middle };

// Held while something else happens.
struct Modifiers {
  bool shift = false, control = false, alt = false;
};

struct WindowEvent {
  enum class Kind : uint8_t { keyDown, keyUp, buttonDown, buttonUp, move, scroll, focusLost };
  Kind kind = Kind::move;
  Time time{};
  int key =
      0;  // keyDown, keyUp: a letter or digit as its ASCII capital, '?' as typed, else one of key::
  Button button = Button::left;
  Modifiers modifiers;
  Vec2 pointer{0};    // in the window [screen units], y downwards
  float notches = 0;  // scroll: away from the person is positive
};

// Keys that are no character.
namespace key {
inline constexpr int kEscape = 256, kTab = 258, kDelete = 261, kHome = 268, kF1 = 290;
}  // namespace key

}  // namespace ninefold
