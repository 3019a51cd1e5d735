// result_group.h: results of tasks and of units on their way from the workers to the loop, in
// groups.
//
// Handing over a result wakes three threads: the loop's, the master's and one of its workers. Each
// has lost its code from the caches to rays. On a machine whose cores all render, waking costs
// several times as much as the bytes do. So a result waits for others, unless
//   - it is urgent, or
//   - its task, or the time since the last group went, took kResultsTogether or more, or
//   - the next task here is of another frame or step, or there is none.
// It waits for kResultsTogether and the tasks then at work, at most: a task of the same frame or
// step that is still to be done here will take it along.
//
// Threads: add from workers, take from the loop's thread.   Errors: none.
#pragma once

#include <mutex>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "client/render_job.h"
#include "common/base/clock.h"

namespace ninefold {

class ResultGroup {
 public:
  struct Finished {
    uint32_t line = 0;  // the connection that its task came by
    bool urgent = false;
    std::variant<RenderJob::Done, msg::Stepped> done;

    uint32_t number() const {  // of its frame or step
      const auto* unit = std::get_if<msg::Stepped>(&done);
      return unit != nullptr ? unit->number : std::get<RenderJob::Done>(done).result.frame;
    }
    Duration busy() const {
      const auto* unit = std::get_if<msg::Stepped>(&done);
      return std::chrono::nanoseconds(
          unit != nullptr ? unit->busyNs : std::get<RenderJob::Done>(done).result.busyNs);
    }
  };

  // True if the caller must have the group taken; then false until that is done. nextFrame() gives
  // the number of the next task here, or nothing. It runs under the lock: the task that it saw has
  // not added its result yet, and will take this one along.
  template <typename NextFrame>
  bool add(Finished finished, NextFrame nextFrame, Time now) {
    const std::lock_guard lock(mutex_);
    const bool isLong = finished.busy() >= kResultsTogether;
    const bool goes = finished.urgent || isLong || now - taken_ >= kResultsTogether ||
                      nextFrame() != std::optional(finished.number());
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
