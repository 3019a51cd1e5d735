// web_desk.h: what the conversations of the server share. Internal to the server.
// Threads: the server's, but for what says otherwise.   Owner: the server.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <list>
#include <mutex>

#include "master/web/web_hub.h"
#include "proto/asio.h"
#include "proto/line_limiter.h"

namespace ninefold {

struct WebDesk {
  static constexpr size_t kMostWaiting = 4096;  // in the inbox

  explicit WebDesk(WebSetup s) : setup(std::move(s)) {}

  const WebSetup setup;
  WebHub hub;

  // A running conversation.
  struct Open {
    std::function<void()> close;
    std::function<void()> wake;  // may be null
  };
  std::list<Open> open;

  // Turned away: one line, unless there were too many of them.
  void refuse(const std::string& peer, const std::string& why);
  // What the hub has heard goes to the session. Error if that does not keep up.
  void passOn();
  void wakeAll();

  std::atomic<uint64_t> viewers = 0, refused = 0, bytesSent = 0;  // any thread reads
  LineLimiter lines{10, std::chrono::seconds(10)};

  std::mutex mutex;
  std::condition_variable arrived;
  std::deque<FromViewer> inbox;  // guarded by mutex
  bool woken = false;            // guarded by mutex

  asio::io_context io{1};  // ends first: what waits in it refers to the rest
};

}  // namespace ninefold
