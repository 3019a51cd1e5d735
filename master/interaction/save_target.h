// save_target.h: into which file an edited scene goes: asked once, then always the same. A file
// that is there already, above all the scene that was read, is overwritten only if its name is
// given twice.
// Threads: plain value; looks at the disk.   Errors: none.
// Proved: tests/master/save_target_test.cpp.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace ninefold {

class SaveTarget {
 public:
  explicit SaveTarget(std::filesystem::path scene) : scene_(std::move(scene)) {}

  const std::optional<std::string>& file() const { return file_; }  // nothing before it was chosen
  // Beside the scene, a name that no file has.
  std::string suggestion() const;
  // A person gives a name: nothing, and it is the file from now on; else what there is to say to
  // it.
  std::optional<std::string> choose(const std::string& name);
  // It could not be written: ask again.
  void forget() { file_.reset(); }

 private:
  std::filesystem::path scene_;
  std::optional<std::string> file_;
  std::string warned_;  // the name that was refused last because it is there
};

}  // namespace ninefold
