#include "common/scene/scene_folder.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>

#include "common/base/descriptor.h"
#include "common/base/error.h"
#include "common/base/read_up_to.h"
#include "common/scene/text_lines.h"

namespace ninefold {
namespace {

namespace fs = std::filesystem;

// "http:", "file:", "data:" ..., and Windows' drive letters.
bool hasScheme(std::string_view reference) {
  const size_t colon = reference.find(':');
  return colon != std::string_view::npos && colon > 0 &&
         std::all_of(reference.begin(), reference.begin() + static_cast<ptrdiff_t>(colon),
                     [](unsigned char c) { return std::isalnum(c) != 0 || c == '+' || c == '-'; });
}

bool isBeneath(const fs::path& folder, const fs::path& file) {
  const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return end == folder.end() && rest != file.end();
}

}  // namespace

std::vector<unsigned char> readRegularFile(const fs::path& file, uint64_t limit) {
  // Non-blocking, so that a pipe without a writer cannot hold us before fstat tells what it is.
  const Descriptor fd(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  if (fd.get() < 0 || ::fstat(fd.get(), &status) != 0)
    fail("'{}' cannot be read ({}): check its name and its permissions", file.string(),
         std::strerror(errno));
  if (!S_ISREG(status.st_mode)) fail("'{}' is not a regular file", file.string());
  const auto size = static_cast<uint64_t>(status.st_size);
  if (size > limit)
    fail("'{}' has {} bytes, more than the {} allowed: split or simplify the scene", file.string(),
         size, limit);
  std::vector<unsigned char> bytes(size);
  const size_t got = readUpTo(fd.get(), std::as_writable_bytes(std::span(bytes)));
  if (got < size)
    fail("'{}' ended after {} of {} bytes: it changed or is damaged", file.string(), got, size);
  return bytes;
}

SceneFolder::SceneFolder(const fs::path& sceneFile) {
  if (sceneFile.empty()) return;
  std::error_code error;
  const fs::path parent = sceneFile.parent_path();
  folder_ = fs::canonical(parent.empty() ? fs::path(".") : parent, error);
  if (error) fail("folder '{}' cannot be opened: {}", parent.string(), error.message());
}

// Where the reference leads, beneath the folder; the file need not exist.
fs::path SceneFolder::locate(std::string_view reference) const {
  if (reference.empty() || reference.find('\0') != std::string_view::npos)
    fail("a file name in the scene is empty or has a zero byte");
  const fs::path path(reference);
  const std::string_view shown = reference.substr(0, 200);
  if (path.is_absolute() || hasScheme(reference))
    fail(
        "'{}' is not a path beneath the scene's folder: copy the file there and name it relatively",
        shown);
  if (folder_.empty()) fail("'{}' is missing: this scene has no folder", shown);
  std::error_code error;
  fs::path file = fs::weakly_canonical(folder_ / path, error);
  if (error) fail("'{}' cannot be opened: {}", shown, error.message());
  if (!isBeneath(folder_, file))
    fail("'{}' leads outside the scene's folder: copy the file there", shown);
  return file;
}

bool SceneFolder::exists(std::string_view reference) const {
  std::error_code error;
  return fs::exists(locate(reference), error);
}

std::string SceneFolder::spelled(std::string_view reference) const {
  const fs::path folder = locate(reference).parent_path();
  const size_t name = reference.rfind('/') + 1;
  const std::string wanted = lowerCase(reference.substr(name));
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (lowerCase(entry.path().filename().string()) == wanted)
      return std::string(reference.substr(0, name)) + entry.path().filename().string();
  return {};
}

fs::path SceneFolder::resolve(std::string_view reference) const {
  fs::path file = locate(reference);
  const std::string_view shown = reference.substr(0, 200);
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status))
    fail("'{}' is missing: put it into the scene's folder {}", shown, folder_.string());
  if (!fs::is_regular_file(status)) fail("'{}' is not a regular file", shown);
  return file;
}

std::vector<unsigned char> SceneFolder::read(std::string_view reference, uint64_t limit) const {
  return readRegularFile(resolve(reference), limit);
}

}  // namespace ninefold
