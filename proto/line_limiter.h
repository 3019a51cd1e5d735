// line_limiter.h: keeps unknown peers from filling the log. It lets through so many lines a period;
// the next line of a later period says how many more there were. Pure: the time is told.
// Threads: plain value.
#pragma once

#include <fmt/core.h>

#include <optional>
#include <string>
#include <utility>

#include "common/base/clock.h"

namespace ninefold {

class LineLimiter {
 public:
  LineLimiter(int lines, Duration period) : lines_(lines), period_(period) {}

  // The line to say now, if any.
  std::optional<std::string> admit(const std::string& line, Time now) {
    if (now >= until_) until_ = now + period_, said_ = 0;
    if (said_ >= lines_) {
      ++swallowed_;
      return std::nullopt;
    }
    ++said_;
    if (swallowed_ == 0) return line;
    return fmt::format("{} (and {} more like it)", line, std::exchange(swallowed_, 0));
  }

 private:
  const int lines_;
  const Duration period_;
  Time until_ = Time::min();
  int said_ = 0, swallowed_ = 0;
};

}  // namespace ninefold
