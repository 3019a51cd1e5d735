// result_group.h: results on their way from the workers to the loop, in groups.
//
// Whoever hands a result over wakes the loop's thread, the master's and one of its workers, each
// time with code that rays have driven out of the caches: on a machine that renders with all its
// cores that costs several times as much as the bytes. So a result waits for others, unless
//   - it is urgent,
//   - its task took kResultsTogether or more, or the last group went that long ago,
//   - the task that is next here is of another frame, or there is none.
// So it waits for kResultsTogether and the tasks that are at work then, at most; the end of a task
// of its frame that is queued takes it along.
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
    bool urgent = false;
    RenderJob::Done done;
  };

  // True if somebody is to take the group; not again before that is done. nextFrame() is the frame
  // of the task that is next here, or nothing. It is asked while no other result can be added: a
  // task that it saw is not finished yet, and will take this result along.
  template <typename NextFrame>
  bool add(Finished finished, NextFrame nextFrame, Time now) {
    const std::lock_guard lock(mutex_);
    const msg::Result& result = finished.done.result;
    const bool isLong = std::chrono::nanoseconds(result.busyNs) >= kResultsTogether;
    const bool goes = finished.urgent || isLong || now - taken_ >= kResultsTogether ||
                      nextFrame() != std::optional(result.frame);
    results_.push_back(std::move(finished));
    return goes && !std::exchange(called_, true);
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
