// film_keeper.h: what keeps the film of a headless run when the run is ended: a copy of it between
// two frames, with the version of the method's state that lit the last of them, and the checkpoint
// file that is made of the copy.
//
// The copy is made after each frame, while no worker adds to the film. The file is written of it
// while they go on: each minute, or as --save-every says, and at the end. A file that cannot be
// written is told in one line; the run goes on and tries again.
//
// With --verify there are two copies more: the *base* is trusted, the *candidate* waits for that
// (scheduling/verification.h). When a client is found wrong, the run goes back to the base. The
// file is then of the base, but at the end.
//
// Memory:  as much as film, guides and extra layers for each copy; nothing without --checkpoint and
//          --verify.
// Threads: stepDone on the network thread; everything else on the film's.
// Errors:  resume, reserve and end throw Error in one line.
#pragma once

#include <map>
#include <mutex>
#include <optional>

#include "common/base/file_lock.h"
#include "master/assembly/picture.h"
#include "master/output/checkpoint.h"
#include "master/running/job.h"
#include "master/running/state_plan.h"
#include "master/serving/server.h"

namespace ninefold {

class FilmKeeper {
 public:
  FilmKeeper(const Options& options, const Job& job, PictureMaker& picture);

  // What the file has is put into the picture. Nothing: there is no file. From now on no other run
  // has it.
  struct Begun {
    int64_t frames = 0;
    double seconds = 0;
    RunBefore run;
  };
  std::optional<Begun> resume();
  // Whether there is room for the picture and the file.
  void reserve() const;

  void stepDone(uint32_t version, const StatePages& pages);
  // A frame is on the film, and no worker adds to it. `seconds`: spent on all so far. True if the
  // frame is a candidate now, so that it is to be marked.
  bool frameDone(const FrameKey& frame, double seconds);
  // All up to this frame is trusted. True if it was the candidate; it is the base from now on.
  bool trusted(uint32_t frame);
  // Puts the base back into the picture. No worker may add to it.
  const Checkpoint& goBack();
  const Checkpoint& base() const { return base_; }
  // The file is to be written as soon as there is something new.
  void hurry() { nextWrite_.reset(); }
  // The file, if it is time.
  void writeIfDue(const ServerTally& tally, Time now);
  // No worker adds to the film any more: puts it back as it was after the last whole frame, and
  // writes the file. `isSettled`: nothing that it has is still to be verified. Error: it cannot be
  // written there, and is somewhere else (output_files.h).
  void end(const ServerTally& tally, bool isSettled);

 private:
  void copy(Checkpoint& to, uint32_t state, double seconds);
  void write(const std::string& file, Checkpoint& what, const ServerTally& tally);
  Checkpoint::Rows rows() const;

  const Options& options_;
  const Job& job_;
  PictureMaker& picture_;
  const bool keeps_, verifies_;
  const bool needsState_;         // what comes after a frame needs the version that lit it
  std::optional<FileLock> lock_;  // on the file
  Checkpoint copy_, base_;
  std::optional<Checkpoint> candidate_;
  uint32_t candidateFrame_ = 0;
  bool isNew_ = false;  // what the file is to have, compared with the file
  bool fails_ = false;  // the file could not be written the last time
  std::optional<Time> nextWrite_;
  std::mutex mutex_;
  std::map<uint32_t, StatePages> versions_;  // guarded by mutex_; since the oldest copy's
};

}  // namespace ninefold
