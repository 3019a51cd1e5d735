// result_group.h: results on their way from the workers to the loop, in groups.
//
// Whoever hands a result over wakes the loop's thread, the master's and one of its workers, each time with code that rays
// have driven out of the caches: on a machine that renders with all its cores that costs several times as much as the bytes.
// So a result waits for others, but never for more than kResultsTogether and the task that its worker goes on with, and not at
// all if it is urgent or no task of its frame waits here.
//
// Threads: add from workers, take from the loop's thread. Errors: none.
#pragma once

#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "client/render_job.h"
#include "common/base/clock.h"

namespace ninefold {

class ResultGroup {
 public:
  struct Finished {
    uint32_t line = 0;  // the connection that its task came by
    RenderJob::Done done;
  };

  // True if the group is to be taken now; then once until it is. next: frame of the task that waits
  // longest, if one does; nothing if the result is urgent.
  bool add(Finished finished, std::optional<uint32_t> next, Time now) {
    const std::lock_guard lock(mutex_);
    const bool last = next != finished.done.result.frame;
    results_.push_back(std::move(finished));
    if (called_ || (!last && now - taken_ < kResultsTogether)) return false;
    return called_ = true;
  }

  std::vector<Finished> take(Time now) {
    const std::lock_guard lock(mutex_);
    called_ = false, taken_ = now;
    return std::exchange(results_, {});
  }

 private:
  std::mutex mutex_;
  std::vector<Finished> results_;  // guarded by mutex_, as all below
  bool called_ = false;
  Time taken_{};
};

}  // namespace ninefold
