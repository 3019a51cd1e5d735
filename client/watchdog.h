// watchdog.h: notices that a task does not end. A native library that does not return gives nothing
// back, so all that is left is to end the process. Whoever started it may start it again.
//
//   limit = msg::Tasks::allowed + kGrace      in time in which this process runs
//
// A stopped process or a machine that sleeps is not the task's fault.
//
//   TaskClock   the times of the tasks at work; a pure value that is told how much time has passed
//   Watchdog    a thread that tells it and calls `onHang`, once
//
// Threads: begin and end from the workers, onHang on the watchdog's own.
// Owner: joins its thread when destroyed.   Errors: none.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "common/base/clock.h"

namespace ninefold {

class TaskClock {
 public:
  struct AtWork {
    std::function<std::string()> describe;
    Duration limit, spent{0};
  };

  explicit TaskClock(int threads) : tasks_(static_cast<size_t>(threads)) {}

  void begin(int thread, Duration limit, std::function<std::string()> describe);
  void end(int thread) { tasks_[static_cast<size_t>(thread)].reset(); }
  // Adds `time` to all tasks at work. Gives one that has had its limit, else null.
  const AtWork* pass(Duration time);

 private:
  std::vector<std::optional<AtWork>> tasks_;  // by thread
};

class Watchdog {
 public:
  static constexpr Duration kGrace = std::chrono::minutes(1);
  static constexpr Duration kLook = milliseconds(100);  // looks are about that far apart
  static constexpr Duration kLongestLook = std::chrono::seconds(1);  // and count as that at most

  // `onHang`: gets what the task is, and for how long it has been at work.
  using OnHang = std::function<void(const std::string& task, Duration time)>;
  Watchdog(int threads, Duration grace, OnHang onHang);
  ~Watchdog();
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

  // `describe` is called if it comes to that, while the task is at work.
  void begin(int thread, Duration allowed, std::function<std::string()> describe);
  void end(int thread);

 private:
  void watch();

  const Duration grace_;
  const OnHang onHang_;
  std::mutex mutex_;
  TaskClock clock_;  // guarded by mutex_, as ending_
  bool ending_ = false;
  std::condition_variable ends_;
  std::thread thread_;
};

}  // namespace ninefold
