// stall_watch.h: when to say that nothing moves, and when to give up. A pure value that is told the
// time.
//
// It is said at once, and again after 30 s, 60 s, 120 s, ... Time in which the program itself did
// not run (it was stopped, the machine slept) does not count.
// Threads: plain value.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "common/base/clock.h"

namespace ninefold {

class StallWatch {
 public:
  static constexpr Duration kSayAgain = std::chrono::seconds(30);
  static constexpr Duration kPause =
      std::chrono::seconds(1);  // looks are closer together than that

  // `patience`: nothing: never gives up.
  explicit StallWatch(std::optional<Duration> patience) : patience_(patience) {}

  // True if it is to be said now that nothing moves.
  bool look(bool nothingMoves, Time now);
  // For how long nothing has moved; 0 if something does.
  Duration time() const { return time_; }
  bool isEndless() const { return !patience_; }
  bool isOver() const { return patience_ && time_ >= *patience_; }
  uint64_t stalls() const { return stalls_; }

 private:
  const std::optional<Duration> patience_;
  std::optional<Time> last_;
  bool stalled_ = false;
  Duration time_{0}, sayAt_{0};
  uint64_t stalls_ = 0;
};

}  // namespace ninefold
