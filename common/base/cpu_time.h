// cpu_time.h: the processor time and memory that this thread or process has used so far.
// Threads: any.
#pragma once

#include <sys/resource.h>

#include <ctime>

#include "common/base/clock.h"

namespace ninefold {

inline Duration cpuTimeOf(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return std::chrono::seconds(t.tv_sec) + std::chrono::nanoseconds(t.tv_nsec);
}
inline Duration threadCpuTime() { return cpuTimeOf(CLOCK_THREAD_CPUTIME_ID); }
inline Duration processCpuTime() { return cpuTimeOf(CLOCK_PROCESS_CPUTIME_ID); }

// The most memory that was ever resident [bytes].
inline uint64_t peakMemory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<uint64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace ninefold
