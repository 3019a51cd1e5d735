#include "client/watchdog.h"

#include <algorithm>

namespace ninefold {

void TaskClock::begin(int thread, Duration limit, std::function<std::string()> describe) {
  tasks_[static_cast<size_t>(thread)] = AtWork{std::move(describe), limit};
}

const TaskClock::AtWork* TaskClock::pass(Duration time) {
  const AtWork* over = nullptr;
  for (std::optional<AtWork>& task : tasks_) {
    if (!task) continue;
    task->spent += time;
    if (task->spent > task->limit) over = &*task;
  }
  return over;
}

Watchdog::Watchdog(int threads, Duration grace, OnHang onHang)
    : grace_(grace), onHang_(std::move(onHang)), clock_(threads), thread_([this] { watch(); }) {}

Watchdog::~Watchdog() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  ends_.notify_one();
  thread_.join();
}

void Watchdog::begin(int thread, Duration allowed, std::function<std::string()> describe) {
  const std::lock_guard lock(mutex_);
  clock_.begin(thread, allowed + grace_, std::move(describe));
}

void Watchdog::end(int thread) {
  const std::lock_guard lock(mutex_);
  clock_.end(thread);
}

void Watchdog::watch() {
  std::unique_lock lock(mutex_);
  Time last = Clock::now();
  while (!ends_.wait_for(lock, kLook, [this] { return ending_; })) {
    const Duration passed = Clock::now() - last;
    last += passed;
    if (const TaskClock::AtWork* task = clock_.pass(std::min(passed, kLongestLook)))
      return onHang_(task->describe(), task->spent);
  }
}

}  // namespace ninefold
