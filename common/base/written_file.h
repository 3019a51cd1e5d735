// written_file.h: the one way in which programs write files: whole, or as they were before.
//
//   target    what the name leads to through symbolic links; the links stay
//   beside    the bytes go to a new file in the target's folder, .ninefold.PID.N.part
//   publish   sync, compare the size with what was written, rename over the target
//
// The new file takes the mode of the one that it replaces and, if the system allows, its owner.
// Refused: what is no regular file (folder, device, pipe), write-protected or a mount of its own.
// Each writer has its own file beside the target: of two at the same time the last one wins, whole.
// A living writer holds a lock on its file. A file without a lock is a killed writer's:
// checkWritable removes it.
//
// Owner:   a local variable; bytes that were not published go with it.
// Threads: one at a time.   Errors: throws Error in one line, "cannot write NAME: ...".
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "common/base/descriptor.h"

namespace ninefold {

struct FileRights {
  mode_t mode = 0666;      // of a file that was not there, less the process's mask
  bool mayReplace = true;  // false: nothing may be there, not even a link
};

class WrittenFile {
 public:
  explicit WrittenFile(const std::filesystem::path& name, FileRights rights = {});
  ~WrittenFile();
  WrittenFile(const WrittenFile&) = delete;
  WrittenFile& operator=(const WrittenFile&) = delete;

  void write(std::string_view bytes) { writeAt(size_, bytes); }  // at the end
  void writeAt(uint64_t offset, std::string_view bytes);
  uint64_t size() const { return size_; }
  // Throws if there is no room for so many bytes, as far as the file system can tell.
  void reserve(uint64_t bytes);
  // Where the bytes are until then. Another program may write them there; then takeWhatIsThere,
  // which believes that they are all.
  const std::filesystem::path& beside() const { return beside_; }
  void takeWhatIsThere();
  // Last. Nothing is to be seen under the name before. Throws if any write has failed.
  void publish();

 private:
  [[noreturn]] void failWith(int error) const;
  void createBeside(mode_t mode);
  void inheritRights();

  const std::filesystem::path name_, target_;
  const bool mayReplace_;
  std::filesystem::path beside_;  // empty: nothing is there
  Descriptor fd_;
  uint64_t size_ = 0;
  int failure_ = 0;  // errno of the first write that failed
};

// What a name leads to through symbolic links, whether it is there or not: a path from the root.
std::filesystem::path targetOf(const std::filesystem::path& name);

// Throws if the file could not be written, or had no room for so many bytes. Call it before the
// work that leads to the file.
void checkWritable(const std::filesystem::path& name, uint64_t bytes = 0);

void writeFile(const std::filesystem::path& name, std::string_view bytes, FileRights rights = {});

}  // namespace ninefold
