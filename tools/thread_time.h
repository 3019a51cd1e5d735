// thread_time.h: processor time of this thread that some work takes.
// Threads: any.
#pragma once

#include "common/base/cpu_time.h"

namespace ninefold {

// [ms]
template <typename Work>
double threadTime(const Work& work) {
  const Duration start = threadCpuTime();
  work();
  return 1e3 * seconds(threadCpuTime() - start);
}

}  // namespace ninefold
