// progress.h: how far a run is, in words. Pure: it is told the time and gives the text to print on
// stderr, or nothing when it is not yet time again.
//
//   terminal    one line, drawn over and over:      [#####.......]  42%  frame 27 of 64  eta 12 s
//   otherwise   lines that programs can read:       progress: 42% frame 27 of 64 eta 12 s
//
// Threads: plain value.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/base/clock.h"

namespace ninefold {

struct ProgressState {
  double fraction = 0;             // done, 0 to 1
  int64_t frames = 0;              // complete
  std::optional<int64_t> of = {};  // frames in all, if that is known
  std::optional<Time> begun = {};  // when this run's work began, if not with the program
  double before = 0;               // of the fraction, done by runs before
  std::string note = {};           // e.g. "2 clients", "1 client fetches the scene, 63%"
};

class Progress {
 public:
  static constexpr Duration kRedraw = milliseconds(100);  // at most that often on a terminal
  static constexpr Duration kLine = milliseconds(1000);   // and so often a line

  Progress(bool terminal, Time start) : terminal_(terminal), start_(start) {}

  // What to print now, line end included if there is one.
  std::optional<std::string> update(const ProgressState& state, Time now);
  // What ends it: leaves a terminal on a fresh line. Nothing may be printed after it.
  std::string finish(const ProgressState& state, Time now);

 private:
  std::string describe(const ProgressState& state, Time now) const;
  std::string draw(const ProgressState& state, Time now) const;

  bool terminal_;
  Time start_;
  std::optional<Time> printed_;
  std::string last_;
};

}  // namespace ninefold
