// event_loop.h: the one thread that talks to the network. A program's main makes it and runs it.
//
// Connections, timers and signals call back inside run(), one at a time: what only these callbacks
// touch needs no lock. Asio stays behind this header and connection.h.
// Threads: run() in one thread; post() and stop() from any thread (not from a signal handler); the
// rest in the loop's thread or before run().
// Owner: outlives every Connection, Listener and connect() made on it.
// Errors: an Error that a callback throws ends run(), which throws it on.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "common/base/clock.h"

namespace ninefold {

class EventLoop {
 public:
  EventLoop();
  ~EventLoop();
  EventLoop(const EventLoop&) = delete;
  EventLoop& operator=(const EventLoop&) = delete;

  void run();   // until stop(); may be called again
  void stop();  // run() returns after the callback that is running now
  void post(std::function<void()> work);

  // Calls back once after `delay`. Dropping the handle cancels it.
  class Timer {
   public:
    virtual ~Timer() = default;
  };
  [[nodiscard]] std::unique_ptr<Timer> after(Duration delay, std::function<void()> work);

  // Calls back for each of these signals (Ctrl-C, SIGTERM, SIGCHLD), as ordinary work of the loop.
  void onSignal(const std::vector<int>& signals, std::function<void(int)> work);

  struct Impl;
  Impl& impl() { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace ninefold
