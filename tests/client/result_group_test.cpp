#include "client/result_group.h"

#include <gtest/gtest.h>

namespace ninefold {
namespace {

class ResultGroupTest : public testing::Test {
 protected:
  // A result of `frame` at `ms`; the next task that waits is of frame `next`.
  bool add(uint32_t frame, std::optional<uint32_t> next, double ms) {
    ResultGroup::Finished finished;
    finished.done.result.frame = frame;
    return group_.add(std::move(finished), next, at(ms));
  }
  size_t take(double ms) { return group_.take(at(ms)).size(); }
  static Time at(double ms) {
    return Time{} + std::chrono::hours(1) +
           duration_cast<Duration>(std::chrono::duration<double, std::milli>(ms));
  }

  ResultGroup group_;
  const size_t begun_ = take(0);
};

TEST_F(ResultGroupTest, WaitsWhileTasksOfTheSameFrameAreThere) {
  EXPECT_FALSE(add(7, 7, 1));
  EXPECT_FALSE(add(7, 7, 2));
  EXPECT_FALSE(add(7, 7, 3));
  EXPECT_TRUE(add(7, 7, 4));
  EXPECT_EQ(take(4), 4u);
}

TEST_F(ResultGroupTest, GoesAtOnceWithTheLastTaskOfAFrame) {
  EXPECT_FALSE(add(7, 7, 1));
  EXPECT_TRUE(add(7, 8, 1.5));
  EXPECT_EQ(take(1.5), 2u);
  EXPECT_TRUE(add(8, std::nullopt, 1.6));
  EXPECT_EQ(take(1.6), 1u);
}

TEST_F(ResultGroupTest, LongTasksAreNotHeldBack) {
  EXPECT_TRUE(add(7, 7, 20));
  EXPECT_EQ(take(20), 1u);
  EXPECT_TRUE(add(7, 7, 40));
}

TEST_F(ResultGroupTest, IsCalledForOnceUntilItIsTaken) {
  EXPECT_TRUE(add(7, 7, 5));
  EXPECT_FALSE(add(7, 7, 6));
  EXPECT_FALSE(add(7, std::nullopt, 7));
  EXPECT_EQ(take(8), 3u);
  EXPECT_EQ(take(8), 0u);
  EXPECT_TRUE(add(7, std::nullopt, 9));
}

}  // namespace
}  // namespace ninefold
