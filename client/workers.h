// workers.h: the threads of a client that render. Of a task they know its frame or step, so that
// tasks of a superseded one can be dropped; what a task does is the caller's.
//
// Threads: start and cancel from one thread (the network thread); jobs run on the workers.
// Owner: joins its threads when destroyed; waiting tasks are dropped, running ones finished.
// Errors: a job must not throw.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <thread>
#include <vector>

#include "common/base/concurrency.h"

namespace ninefold {

class Workers {
 public:
  // What a worker does for one task; `thread` is 0..threads-1, for state of its own.
  using Job = std::function<void(int thread)>;

  Workers(int threads, size_t capacity);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  // False when `capacity` tasks wait already. `frame`: or the number of a step.
  bool start(uint32_t frame, Job job, bool isStep = false);
  // Frame of the task that is next, if one waits. From any thread.
  std::optional<uint32_t> nextFrame() const {
    return queue_.front([](const Entry& entry) { return entry.frame; });
  }
  // Drops the waiting tasks of frames, and units of steps, for which `drop` is true. Gives their
  // number.
  size_t cancel(const std::function<bool(uint32_t frame, bool isStep)>& drop);

 private:
  struct Entry {
    uint32_t frame = 0;
    bool isStep = false;
    Job job;
  };
  void run(int thread);

  BoundedQueue<Entry> queue_;
  std::vector<std::thread> threads_;
};

}  // namespace ninefold
