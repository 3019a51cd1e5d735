#include "master/interaction/save_target.h"

#include <fmt/format.h>

namespace ninefold {

namespace fs = std::filesystem;

std::string SaveTarget::suggestion() const {
  std::error_code ignored;
  for (int i = 1;; ++i) {
    const std::string end = i == 1 ? "-edited.glb" : fmt::format("-edited-{}.glb", i);
    const fs::path file = scene_.parent_path() / (scene_.stem().string() + end);
    if (!fs::exists(file, ignored)) return file.string();
  }
}

std::optional<std::string> SaveTarget::choose(const std::string& name) {
  if (!name.ends_with(".glb") || fs::path(name).filename() == ".glb")
    return "the name must end in .glb";
  std::error_code problem;
  if (fs::exists(name, problem) && name != warned_) {
    warned_ = name;
    return fs::equivalent(name, scene_, problem)
               ? "this is the scene that was read: save again to write over it"
               : "the file is there already: save again to write over it";
  }
  file_ = name;
  return std::nullopt;
}

}  // namespace ninefold
