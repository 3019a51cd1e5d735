// scene_folder.h: the only way from a path written in a scene file to bytes. What a file names
// resolves to a regular file beneath the scene's folder (after symbolic links) or to nothing.
//
// Threads: reentrant.   Errors: throws Error (missing, outside, not a regular file, too big).
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ninefold {

// Bytes of a regular file; refuses devices, pipes and folders, and more than `limit` bytes.
std::vector<unsigned char> readRegularFile(const std::filesystem::path& file, uint64_t limit);

class SceneFolder {
 public:
  // The folder that holds `sceneFile`. An empty path gives a folder in which nothing is found.
  explicit SceneFolder(const std::filesystem::path& sceneFile);

  // `reference`: a relative path, percent-decoded already.
  std::filesystem::path resolve(std::string_view reference) const;
  std::vector<unsigned char> read(std::string_view reference, uint64_t limit) const;
  // False if there is no such file; what leads outside is an Error all the same.
  bool exists(std::string_view reference) const;
  // The reference as its folder spells it: a file whose name may differ in case; empty if there is
  // none. Errors as exists.
  std::string spelled(std::string_view reference) const;

 private:
  std::filesystem::path locate(std::string_view reference) const;
  std::filesystem::path folder_;  // canonical
};

}  // namespace ninefold
