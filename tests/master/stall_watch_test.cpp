// When nothing moves: said at once and after 30, 60, 120 s, given up after the patience that was
// stated.
#include "master/scheduling/stall_watch.h"

#include <gtest/gtest.h>

#include <vector>

namespace ninefold {
namespace {

using std::chrono::seconds;

class Looking {
 public:
  explicit Looking(std::optional<Duration> patience) : watch(patience) {}
  // Looks every 20 ms; the times since the first look at which something was to be said [s].
  void pass(Duration time, bool nothingMoves) {
    for (const Time end = now + time; now < end; now += milliseconds(20))
      if (watch.look(nothingMoves, now)) said.push_back(ninefold::seconds(now - Time{}));
  }
  StallWatch watch;
  Time now{};
  std::vector<double> said;
};

TEST(StallWatch, SaysItAtOnceAndEverMoreRarely) {
  Looking l(std::nullopt);
  l.pass(seconds(10), false);
  EXPECT_TRUE(l.said.empty());
  l.pass(seconds(130), true);
  ASSERT_EQ(l.said.size(), 4u);
  for (size_t i = 0; i < 4; ++i) EXPECT_NEAR(l.said[i], (std::array{10, 40, 70, 130})[i], 0.1);
  EXPECT_FALSE(l.watch.isOver());
  EXPECT_EQ(l.watch.stalls(), 1u);
}

TEST(StallWatch, GivesUpAfterItsPatienceAndNotBefore) {
  Looking l(seconds(50));
  l.pass(seconds(49), true);
  EXPECT_FALSE(l.watch.isOver());
  l.pass(milliseconds(100), false);  // something moved: it counts anew
  l.pass(seconds(50), true);
  EXPECT_FALSE(l.watch.isOver());
  l.pass(milliseconds(200), true);
  EXPECT_TRUE(l.watch.isOver());
  EXPECT_EQ(l.watch.stalls(), 2u);
}

TEST(StallWatch, TimeInWhichNobodyLookedDoesNotCount) {
  Looking l(seconds(50));
  l.pass(seconds(10), true);
  l.now += std::chrono::hours(9);
  l.pass(seconds(10), true);
  EXPECT_FALSE(l.watch.isOver());
  EXPECT_NEAR(ninefold::seconds(l.watch.time()), 20, 0.1);
}

}  // namespace
}  // namespace ninefold
