// window_keys.h: all keys and buttons of the window in one table: the input looks up here what a
// key does, and people are shown the same lines (F1, docs/window.md).
// Threads: constants. Errors: none. Proved: tests/master/window_keys_test.cpp.
#pragma once

#include <optional>
#include <span>

#include "master/interaction/window_input.h"

namespace ninefold {

struct WindowKey {
  const char* keys;  // as people read them
  const char* does;
  enum class Use : uint8_t { told, fly, axis, view, command };
  Use use = Use::told;  // told: by the pointer, or beside other keys
  int key = 0;          // WindowEvent::key
  FlyKey fly = FlyKey::forward;
  Command::Kind command = Command::Kind::close;
  bool control = false, shift = false;  // held with it; without `shift` it may be held or not
  float amount = 0;                     // of the command
};

std::span<const WindowKey> windowKeys();

// What a key does while these are held; nothing if it does nothing.
const WindowKey* meaningOf(int key, const Modifiers& held);

}  // namespace ninefold
