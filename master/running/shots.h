// shots.h: what is on the screen at fixed moments of a session in real time, written beside it.
//
//   shot i = 0, 1, ..., count-1   the picture that was there at i/rate [s] after the start
//
// Frames do not wait for files: pictures stand in a queue for a thread of its own. Where too many
// wait a shot is lost, and counted. Its entry says what was to be seen.
//
// Memory:  kMostWaiting pictures and one more.
// Errors:  after the first file that cannot be written no other one is; finish() throws its Error.
// Threads: take from any, one at a time; Write is called on a thread of its own.
// Proved:  tests/master/shots_test.cpp, tests/cluster/script_test.py.
#pragma once

#include <exception>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "common/base/concurrency.h"
#include "master/running/live_run.h"

namespace ninefold {

struct Shot {
  int number = 0;
  uint32_t frame = 0;            // the newest one of the picture
  double opened = 0, shown = 0;  // of that frame: what it shows, and when it was there [s]
  int64_t frames = 0;            // that the picture is the mean of
  bool isLost = false;           // there is no file of it
};

class Shots {
 public:
  static constexpr size_t kMostWaiting = 16;
  using Write = std::function<void(int number, const Shown& shown)>;
  Shots(Time start, double rate, int count, Write write);
  ~Shots();

  // Those that have become due until `now`, all of `shown`: call it before another one is seen.
  void take(Time now, const std::shared_ptr<const Shown>& shown);
  // All of them, once their files are written.
  const std::vector<Shot>& finish();

 private:
  struct Waiting {
    int number;
    std::shared_ptr<const Shown> shown;
  };
  void writeAll();
  bool isDue(Time now) const;

  const Time start_;
  const double rate_;
  const int count_;
  const Write write_;
  std::vector<Shot> taken_;
  BoundedQueue<Waiting> waiting_{kMostWaiting};
  std::exception_ptr failure_;  // of the thread, for those who have joined it
  std::thread thread_;
};

}  // namespace ninefold
