// recording.h: a client's work kept in a file, to be sent again or done again, task by task.
//
//   recording := frames (PROTOCOL.md): the client's Hello, then as they came the master's
//                SceneOffer, Edit, Configure, Tasks, Steps, StateDelta and StateOffer, its
//                BlobChunks of pages, and the client's Result for each task, Stepped for each unit
//
// The file is whole or as it was before (written_file.h).
// Errors: throw Error that names the file.   Threads: a Recorder from any thread; the rest pure.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <set>
#include <vector>

#include "common/base/written_file.h"
#include "proto/messages.h"

namespace ninefold {

class Recorder {
 public:
  Recorder(const std::filesystem::path& file, const msg::Hello& hello);
  void add(const msg::Result& result);
  void add(const msg::Stepped& stepped);
  // A message of the master's: kept if it says what tasks there are and how they are done.
  void heard(const Message& message);
  // Puts the file into its place. What comes later is left out.
  void finish();

 private:
  void write(Message message);

  std::mutex mutex_;
  std::unique_ptr<WrittenFile> file_;  // guarded by mutex_; null once finished
  std::set<Sha256> pages_;             // guarded by mutex_; blobs that are pages of a state
};

// In the file's order. A last message that was cut short (a full disk) is left out.
std::vector<Message> readRecording(const std::filesystem::path& file);

}  // namespace ninefold
