#include "common/base/concurrency.h"

#include <gtest/gtest.h>

#include <numeric>
#include <thread>
#include <vector>

namespace ninefold {
namespace {

TEST(BoundedQueue, RefusesWhatDoesNotFitAndLeavesItUntouched) {
  BoundedQueue<std::vector<int>> queue(1);
  std::vector<int> first{1}, second{2, 3};
  EXPECT_TRUE(queue.tryPush(first));
  EXPECT_FALSE(queue.tryPush(second));
  EXPECT_EQ(second, (std::vector<int>{2, 3}));
}

TEST(BoundedQueue, GivesWhatIsInsideAfterClosingAndThenNothing) {
  BoundedQueue<int> queue(4);
  for (int value : {1, 2}) queue.tryPush(value);
  queue.close();
  int late = 3;
  EXPECT_FALSE(queue.tryPush(late));
  EXPECT_EQ(queue.pop(), 1);
  EXPECT_EQ(queue.pop(), 2);
  EXPECT_EQ(queue.pop(), std::nullopt);
}

TEST(BoundedQueue, ShowsWhatIsNext) {
  BoundedQueue<int> queue(4);
  const auto next = [&] { return queue.front([](int value) { return 10 * value; }); };
  EXPECT_EQ(next(), std::nullopt);
  for (int value : {1, 2}) queue.tryPush(value);
  EXPECT_EQ(next(), 10);
  queue.pop();
  EXPECT_EQ(next(), 20);
}

TEST(BoundedQueue, ClosingFreesEverybodyWhoWaits) {
  BoundedQueue<int> queue(1);
  std::vector<std::thread> waiting;
  for (int i = 0; i < 3; ++i) waiting.emplace_back([&] { EXPECT_EQ(queue.pop(), std::nullopt); });
  queue.close();
  for (std::thread& thread : waiting) thread.join();
}

TEST(BoundedQueue, EveryEntryReachesExactlyOneConsumer) {
  constexpr int kEntries = 10000;
  BoundedQueue<int> queue(16);
  std::vector<long> sums(3);
  std::vector<std::thread> consumers;
  for (long& sum : sums)
    consumers.emplace_back([&queue, &sum] {
      while (const auto value = queue.pop()) sum += *value;
    });
  for (int i = 1; i <= kEntries; ++i)
    for (int value = i; !queue.tryPush(value);) std::this_thread::yield();
  queue.close();
  for (std::thread& thread : consumers) thread.join();
  EXPECT_EQ(std::accumulate(sums.begin(), sums.end(), 0L), kEntries * (kEntries + 1L) / 2);
}

TEST(BoundedQueue, RemovesOnlyWhatIsAskedForAndKeepsTheOrder) {
  BoundedQueue<int> queue(8);
  for (int i = 0; i < 6; ++i)
    if (int value = i; !queue.tryPush(value)) FAIL();
  const auto removed = queue.removeIf([](int value) { return value % 2 == 0; });
  EXPECT_EQ(removed, (std::deque<int>{0, 2, 4}));
  for (int expected : {1, 3, 5}) EXPECT_EQ(queue.pop(), expected);
}

}  // namespace
}  // namespace ninefold
