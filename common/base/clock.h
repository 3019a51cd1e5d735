// clock.h: points in time are values. Only a program's main and the connection read the clock.
// All else is told the time, so that tests and the simulated cluster can set it.
#pragma once

#include <chrono>

namespace ninefold {

using Clock = std::chrono::steady_clock;
using Time = Clock::time_point;
using Duration = Clock::duration;

using std::chrono::duration_cast;
using std::chrono::milliseconds;

inline double seconds(Duration d) { return std::chrono::duration<double>(d).count(); }
inline Duration fromSeconds(double s) {
  return duration_cast<Duration>(std::chrono::duration<double>(s));
}

}  // namespace ninefold
