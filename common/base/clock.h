// clock.h: points in time are values. Only a program's main and the connection read the clock.
// All else is told the time, so that tests and the simulated cluster can set it.
#pragma once

#include <chrono>
#include <cstdint>

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

// What a clock on the wall shows, in milliseconds since 1970; it may be set at any moment.
inline uint64_t wallClockMs() {
  const auto since = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<uint64_t>(duration_cast<milliseconds>(since).count());
}

}  // namespace ninefold
