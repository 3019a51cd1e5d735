#include "proto/wire_level.h"

#include <gtest/gtest.h>

namespace ninefold {
namespace {

// Results of 14 kB every 4 ms on each of two threads: 7 MB a second.
WireLevel busyClient() {
  WireLevel level;
  for (int i = 0; i < 100; ++i) level.finished(14'000, milliseconds(4));
  return level;
}

TEST(WireLevel, FollowsTheLine) {
  EXPECT_EQ(busyClient().choose(2e9, 2), WireLevel::kNone) << "loopback";
  EXPECT_EQ(busyClient().choose(117e6, 2), WireLevel::kNone) << "gigabit";
  EXPECT_EQ(busyClient().choose(11.7e6, 2), WireLevel::kLight) << "100 Mbit/s";
  EXPECT_EQ(busyClient().choose(1.2e6, 2), WireLevel::kStrong) << "10 Mbit/s";
}

TEST(WireLevel, CountsAllThreads) {
  EXPECT_EQ(busyClient().choose(117e6, 16), WireLevel::kLight);
  EXPECT_EQ(busyClient().choose(117e6, 64), WireLevel::kStrong);
}

TEST(WireLevel, ForgetsSlowTasks) {
  WireLevel level;
  level.finished(14'000, std::chrono::seconds(2));
  EXPECT_EQ(level.choose(1.2e6, 2), WireLevel::kNone);
  for (int i = 0; i < 100; ++i) level.finished(14'000, milliseconds(4));
  EXPECT_EQ(level.choose(1.2e6, 2), WireLevel::kStrong);
}

TEST(WireLevel, IsLightUntilSomethingIsKnown) {
  EXPECT_EQ(WireLevel().choose(1e9, 1), WireLevel::kLight);
  EXPECT_EQ(busyClient().choose(0, 1), WireLevel::kLight);
}

}  // namespace
}  // namespace ninefold
