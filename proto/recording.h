// recording.h: results of a client kept in a file, to be sent again by a replay client.
//
//   recording := the frames that a client sends: Hello, then a Result for each task (PROTOCOL.md)
//
// The file is whole or as it was before (written_file.h). Errors: throw Error that names the file.
// Threads: a Recorder from any thread; the rest pure.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <vector>

#include "common/base/written_file.h"
#include "proto/messages.h"

namespace ninefold {

class Recorder {
 public:
  Recorder(const std::filesystem::path& file, const msg::Hello& hello);
  void add(const msg::Result& result);
  // The file is there from now on; what comes later is left out.
  void finish();

 private:
  void write(Message message);

  std::mutex mutex_;
  std::unique_ptr<WrittenFile> file_;  // guarded by mutex_; null once finished
};

std::vector<msg::Result> readRecording(const std::filesystem::path& file);

}  // namespace ninefold
