// recording.h: results of a client kept in a file, to be sent again by a replay client.
//
//   recording := the frames that a client sends: Hello, then a Result for each task (PROTOCOL.md)
//
// Errors: throw Error that names the file. Threads: a Recorder from any thread; the rest pure.
#pragma once

#include <filesystem>
#include <fstream>
#include <mutex>
#include <vector>

#include "proto/messages.h"

namespace ninefold {

class Recorder {
 public:
  Recorder(const std::filesystem::path& file, const msg::Hello& hello);
  void add(const msg::Result& result);

 private:
  void write(Message message);

  const std::filesystem::path path_;
  std::mutex mutex_;
  std::ofstream file_;  // guarded by mutex_
};

std::vector<msg::Result> readRecording(const std::filesystem::path& file);

}  // namespace ninefold
