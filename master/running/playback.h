// playback.h: a script against the clock of a window. It plays and pauses; at its end it stays
// there, or begins again. Pure.
// Threads: plain value.   Errors: as ScriptPlayer.   Proved: tests/master/script_test.cpp.
#pragma once

#include <cmath>

#include "common/base/clock.h"
#include "master/running/script_player.h"

namespace ninefold {

class Playback {
 public:
  Playback(ScriptPlayer player, bool repeats) : player_(std::move(player)), repeats_(repeats) {}

  // Time passes. What is different then.
  ScriptPlayer::Step pass(Duration time) {
    if (!playing_) return {};
    const double end = player_.script().seconds;
    at_ += seconds(time);
    if (repeats_ && end > 0)
      at_ = std::fmod(at_, end);
    else if (at_ >= end)
      at_ = end, playing_ = false;
    return player_.moveTo(at_);
  }
  // Pauses and goes on; after the end from the beginning.
  void toggle() {
    if (!playing_ && at_ >= player_.script().seconds) at_ = 0;
    playing_ = !playing_;
  }
  bool isPlaying() const { return playing_; }

 private:
  ScriptPlayer player_;
  bool repeats_;
  double at_ = 0;  // [s]
  bool playing_ = true;
};

}  // namespace ninefold
