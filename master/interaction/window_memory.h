// window_memory.h: what the window remembers from one session to the next, for each user: lines
// "name number" in $XDG_CONFIG_HOME/ninefold/window (else $HOME/.config/ninefold/window).
//
// Threads: one at a time.
// Errors: none; what cannot be read is forgotten, and where nothing can be written nothing is
// remembered.
// Proved: tests/master/window_layout_test.cpp.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "common/base/command_line.h"

namespace ninefold {

struct WindowMemory {
  int width = 0, height = 0;  // of the window [screen units]; 0: not known
  bool folded = false;        // the panel
  bool operator==(const WindowMemory&) const = default;
};

std::string textOf(const WindowMemory& memory);
WindowMemory memoryOf(const std::string& text);

// Nothing if the environment names no folder.
std::optional<std::filesystem::path> memoryFile(const Variable& variable);
WindowMemory recall(const std::filesystem::path& file);
void remember(const WindowMemory& memory, const std::filesystem::path& file);

}  // namespace ninefold
