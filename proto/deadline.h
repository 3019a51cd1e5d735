// deadline.h: closes something when time is up, unless the Deadline dies before. Internal to the
// connection.
// Threads: the loop's.
#pragma once

#include "proto/asio.h"

namespace ninefold {

class Deadline {
 public:
  Deadline(asio::io_context& io, Duration time, std::function<void()> close)
      : timer_(io, time), late_(std::make_shared<bool>(false)) {
    timer_.async_wait([late = std::weak_ptr(late_), close = std::move(close)](NetError error) {
      const auto flag = late.lock();
      if (error || !flag) return;
      *flag = true;
      close();
    });
  }
  bool passed() const { return *late_; }

 private:
  asio::steady_timer timer_;
  std::shared_ptr<bool> late_;
};

}  // namespace ninefold
