// checkpoint.h: a headless run between two frames, as a file: what the same command needs to go on
// as if it had never ended.
//
//   file     := magic  version u32  SHA-256 of all that follows  job  state  film
//   section  := raw u64  size u64  zstd frame (size bytes, raw when decompressed)
//   job      := rows (name, value), pixel class, instruction set, reproducible u8, frames u64,
//               seconds f64, state's version u32, its pages u32
//   state    := for each page: kind u16, index u32, SHA-256, raw u64, size u64, blob (state_wire.h)
//   film     := PictureMaker::keep
//
// job: all that the film's bytes depend on, in words. Texts: length u32, bytes. Numbers are
// little-endian.
//
// The file is whole or as it was before (written_file.h). It is not trusted: sizes and counts are
// checked before memory is taken, never more than the job's own film and state can need.
// Proved:  tests/master/checkpoint_test.cpp, tests/fuzz/checkpoint.cpp.
// Threads: pure functions, but for the file.
// Errors:  throw Error in one line that names the file.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/state/state_pages.h"
#include "proto/bytes.h"

namespace ninefold {

struct Checkpoint {
  using Rows = std::vector<std::pair<std::string, std::string>>;

  Rows job;
  std::string pixelClass, isa;  // of those who rendered it
  bool reproducible = true;     // all of them had that class
  int64_t frames = 1;           // on the film, 1 or more
  double seconds = 0;           // spent on them
  uint32_t state = 0;           // version that the next step begins from; 0: none
  StatePages pages;             // of that version
  Bytes film;
};

// How large the parts of a job's checkpoint may be [bytes].
struct CheckpointLimits {
  size_t film = 0;
  bool hasState = false;
};

Bytes encodeCheckpoint(const Checkpoint& checkpoint);
// Error: it is damaged, or of another job than `job`, which the line then tells apart.
Checkpoint decodeCheckpoint(ByteView file, const Checkpoint::Rows& job,
                            const CheckpointLimits& limits);

// Nothing if there is no such file.
std::optional<Checkpoint> readCheckpoint(const std::string& file, const Checkpoint::Rows& job,
                                         const CheckpointLimits& limits);
void writeCheckpoint(const std::string& file, const Checkpoint& checkpoint);

}  // namespace ninefold
