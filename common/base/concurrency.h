// concurrency.h: how threads hand work to each other.
//
// BoundedQueue   first in, first out, never more than `capacity` entries. A producer that must not
//                wait uses tryPush and decides itself what to do when there is no room.
//                After close() nothing can be added and nobody waits; what is inside can still
//                be taken.
//
// Threads: all functions from any thread.   Owner: outlives the threads that use it.
#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <type_traits>
#include <utility>

#include "common/base/clock.h"

namespace ninefold {

template <typename T>
class BoundedQueue {
 public:
  explicit BoundedQueue(size_t capacity) : capacity_(capacity) {}

  // False, with `value` untouched, when the queue is full or closed.
  bool tryPush(T& value) {
    {
      const std::lock_guard lock(mutex_);
      if (closed_ || entries_.size() >= capacity_) return false;
      entries_.push_back(std::move(value));
    }
    filled_.notify_one();
    return true;
  }

  // Waits for an entry; nothing once the queue is closed and empty.
  std::optional<T> pop() {
    std::unique_lock lock(mutex_);
    filled_.wait(lock, [this] { return closed_ || !entries_.empty(); });
    return take();
  }

  // As pop, but gives up at `deadline`.
  std::optional<T> popUntil(Time deadline) {
    std::unique_lock lock(mutex_);
    filled_.wait_until(lock, deadline, [this] { return closed_ || !entries_.empty(); });
    return take();
  }

  // Drops the entries for which `drop` is true and gives them back.
  template <typename Predicate>
  std::deque<T> removeIf(Predicate drop) {
    std::deque<T> kept, removed;
    const std::lock_guard lock(mutex_);
    for (T& entry : entries_) (drop(entry) ? removed : kept).push_back(std::move(entry));
    entries_ = std::move(kept);
    return removed;
  }

  // of(next entry); nothing if the queue is empty.
  template <typename Of>
  std::optional<std::invoke_result_t<Of, const T&>> front(Of of) const {
    const std::lock_guard lock(mutex_);
    if (entries_.empty()) return std::nullopt;
    return of(entries_.front());
  }

  void close() {
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
    }
    filled_.notify_all();
  }

  size_t size() const {
    const std::lock_guard lock(mutex_);
    return entries_.size();
  }

 private:
  std::optional<T> take() {
    if (entries_.empty()) return std::nullopt;
    std::optional<T> entry(std::move(entries_.front()));
    entries_.pop_front();
    return entry;
  }

  const size_t capacity_;  // constant after construction
  mutable std::mutex mutex_;
  std::condition_variable filled_;
  std::deque<T> entries_;  // guarded by mutex_
  bool closed_ = false;    // guarded by mutex_
};

}  // namespace ninefold
