#include "proto/event_loop.h"

#include <gtest/gtest.h>

#include <csignal>
#include <thread>

#include "common/base/error.h"

namespace ninefold {
namespace {

TEST(EventLoop, RunsPostedWorkInOrderInItsOwnThread) {
  EventLoop loop;
  std::string order;
  std::thread other([&] {
    for (char c = 'a'; c <= 'z'; ++c) loop.post([&order, c] { order += c; });
    loop.post([&] { loop.stop(); });
  });
  loop.run();
  other.join();
  EXPECT_EQ(order, "abcdefghijklmnopqrstuvwxyz");
}

TEST(EventLoop, TimersFireInOrderAndDroppedOnesDoNot) {
  EventLoop loop;
  std::string order;
  const auto late = loop.after(milliseconds(20), [&] { order += "late", loop.stop(); });
  const auto soon = loop.after(milliseconds(2), [&] { order += "soon "; });
  auto dropped = loop.after(milliseconds(1), [&] { order += "dropped "; });
  dropped.reset();
  loop.run();
  EXPECT_EQ(order, "soon late");
}

TEST(EventLoop, ATimerMayDropItself) {
  EventLoop loop;
  std::unique_ptr<EventLoop::Timer> timer;
  timer = loop.after(milliseconds(1), [&] {
    timer.reset();
    loop.stop();
  });
  loop.run();
  EXPECT_EQ(timer, nullptr);
}

TEST(EventLoop, SignalsAreOrdinaryWork) {
  EventLoop loop;
  int seen = 0;
  loop.onSignal({SIGUSR1}, [&](int signal) {
    EXPECT_EQ(signal, SIGUSR1);
    if (++seen == 2) return loop.stop();
    std::raise(SIGUSR1);
  });
  loop.post([] { std::raise(SIGUSR1); });
  loop.run();
  EXPECT_EQ(seen, 2);
}

TEST(EventLoop, ErrorsOfCallbacksComeOutOfRun) {
  EventLoop loop;
  loop.post([] { fail("no more disk"); });
  EXPECT_THROW(loop.run(), Error);
}

}  // namespace
}  // namespace ninefold
