#include "client/workers.h"

#include <gtest/gtest.h>

#include <atomic>
#include <latch>
#include <set>

namespace ninefold {
namespace {

TEST(Workers, RunAllTasksEachWithAThreadNumberOfItsOwn) {
  std::mutex mutex;
  std::set<int> numbers;
  std::latch all(4), done(4);
  Workers workers(4, 16);
  for (int i = 0; i < 4; ++i)
    ASSERT_TRUE(workers.start(0, [&](int thread) {
      all.arrive_and_wait();  // four at once, so on four threads
      const std::lock_guard lock(mutex);
      numbers.insert(thread);
      done.count_down();
    }));
  done.wait();
  const std::lock_guard lock(mutex);
  EXPECT_EQ(numbers, (std::set<int>{0, 1, 2, 3}));
}

TEST(Workers, RefuseMoreThanTheirBound) {
  std::latch release(1);
  std::latch started(1);
  Workers workers(1, 2);
  ASSERT_TRUE(workers.start(0, [&](int) {
    started.count_down();
    release.wait();
  }));
  started.wait();
  EXPECT_TRUE(workers.start(0, [](int) {}));
  EXPECT_TRUE(workers.start(0, [](int) {}));
  EXPECT_FALSE(workers.start(0, [](int) {}));
  release.count_down();
}

TEST(Workers, DropWaitingTasksOfCancelledFramesOnly) {
  std::latch release(1), started(1), kept(1);
  std::atomic<int> ranCancelled = 0;
  Workers workers(1, 8);
  workers.start(1, [&](int) {
    started.count_down();
    release.wait();
  });
  started.wait();
  workers.start(1, [&](int) { ++ranCancelled; });
  workers.start(1, [&](int) { ++ranCancelled; });
  workers.start(2, [&](int) { kept.count_down(); });
  EXPECT_EQ(workers.cancel([](uint32_t frame, bool) { return frame < 2; }), 2u);
  release.count_down();
  kept.wait();
  EXPECT_EQ(ranCancelled, 0);
}

TEST(Workers, FinishWhatRunsAndDropWhatWaitsWhenDestroyed) {
  std::latch started(1);
  std::atomic<int> finished = 0, waiting = 0;
  {
    Workers workers(1, 8);
    workers.start(0, [&](int) {
      started.count_down();
      std::this_thread::yield();
      ++finished;
    });
    started.wait();
  }
  EXPECT_EQ(finished, 1);
  EXPECT_EQ(waiting, 0);
}

}  // namespace
}  // namespace ninefold
