// written_file.h: the one way in which programs write files: whole, or as they were before.
//
//   target    what the name leads to through symbolic links, which stay
//   beside    the bytes go to a new file in the target's folder, .ninefold.PID.N.part
//   publish   sync, compare the size with what was written, rename over the target
//
// A file that is replaced hands its mode and, if the system allows, its owner on. What is no
// regular file (folder, device, pipe), is write-protected or a mount of its own is refused. Each
// writer has a file of its own beside the target: of two at the same time the last one wins, whole.
// A living writer holds a lock on its file, by which checkWritable knows what a killed one left,
// and takes that away.
// Owner: a local variable; bytes that were not published go with it. Threads: one at a time.
// Errors: throws Error in one line, "cannot write NAME: ...".
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
  // Last. Before it nothing is to be seen under the name. Fails again if a write has failed.
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

// Throws if the file could not be written. Call it before the work that leads to the file.
void checkWritable(const std::filesystem::path& name);

void writeFile(const std::filesystem::path& name, std::string_view bytes, FileRights rights = {});

}  // namespace ninefold
