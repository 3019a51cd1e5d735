#include "master/interaction/window_memory.h"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "common/base/written_file.h"

namespace ninefold {
namespace {

constexpr int kLargest = 1 << 15;  // [screen units]

}  // namespace

std::string textOf(const WindowMemory& memory) {
  return fmt::format("width {}\nheight {}\nfolded {}\n", memory.width, memory.height,
                     memory.folded ? 1 : 0);
}

WindowMemory memoryOf(const std::string& text) {
  WindowMemory memory;
  std::istringstream lines(text);
  std::string name;
  int value = 0;
  while (lines >> name >> value) {
    const bool isLength = value >= 0 && value <= kLargest;
    if (name == "width" && isLength) memory.width = value;
    if (name == "height" && isLength) memory.height = value;
    if (name == "folded") memory.folded = value == 1;
  }
  return memory;
}

std::optional<std::filesystem::path> memoryFile(const Variable& variable) {
  const auto folder = [&](const char* name) -> std::optional<std::filesystem::path> {
    const auto value = variable(name);
    if (!value || !std::filesystem::path(*value).is_absolute()) return std::nullopt;
    return *value;
  };
  if (const auto config = folder("XDG_CONFIG_HOME")) return *config / "ninefold" / "window";
  if (const auto home = folder("HOME")) return *home / ".config" / "ninefold" / "window";
  return std::nullopt;
}

WindowMemory recall(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return memoryOf(text.str());
}

void remember(const WindowMemory& memory, const std::filesystem::path& file) try {
  std::filesystem::create_directories(file.parent_path());
  writeFile(file, textOf(memory));
} catch (const std::exception&) {
  // What cannot be kept is no reason to fail: the next window opens as a first one does.
}

}  // namespace ninefold
