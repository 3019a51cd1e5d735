// file_lock.h: one program at a time has a file, though the file itself is replaced by renaming
// (written_file.h).
//
// The lock is on an empty file beside it, .ninefold.NAME.lock, which goes with this object. One
// that a killed program left is taken over. NAME is what the name leads to through symbolic links.
//
// Owner:   who keeps the file.   Threads: one at a time.
// Errors:  throws Error in one line: another has it; the folder cannot be written.
// Proved:  tests/base/file_lock_test.cpp.
#pragma once

#include <filesystem>

#include "common/base/descriptor.h"

namespace ninefold {

class FileLock {
 public:
  explicit FileLock(const std::filesystem::path& file);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  std::filesystem::path beside_;
  Descriptor fd_;
};

}  // namespace ninefold
