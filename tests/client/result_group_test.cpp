#include "client/result_group.h"

#include <gtest/gtest.h>

#include <latch>
#include <thread>

namespace ninefold {
namespace {

class ResultGroupTest : public testing::Test {
 protected:
  struct Task {
    uint32_t frame = 7;
    bool urgent = false;
    double took = 1;  // [ms]
  };
  ResultGroupTest() { take(0); }

  // A result at `ms`; the next task is of frame `next`.
  bool add(Task task, std::optional<uint32_t> next, double ms) {
    return group_.add(
        resultOf(task), [next] { return next; }, at(ms));
  }
  size_t take(double ms) { return group_.take(at(ms)).size(); }

  static ResultGroup::Finished resultOf(Task task) {
    ResultGroup::Finished finished;
    finished.urgent = task.urgent;
    auto& result = std::get<RenderJob::Done>(finished.done).result;
    result.frame = task.frame, result.busyNs = static_cast<uint64_t>(1e6 * task.took);
    return finished;
  }
  static Time at(double ms) {
    return Time{} + std::chrono::hours(1) +
           duration_cast<Duration>(std::chrono::duration<double, std::milli>(ms));
  }

  ResultGroup group_;
};

TEST_F(ResultGroupTest, WaitsWhileTasksOfTheSameFrameAreThere) {
  EXPECT_FALSE(add({}, 7, 1));
  EXPECT_FALSE(add({}, 7, 2));
  EXPECT_FALSE(add({}, 7, 3));
  EXPECT_TRUE(add({}, 7, 4));
  EXPECT_EQ(take(4), 4u);
}

TEST_F(ResultGroupTest, GoesAtOnceWithTheLastTaskOfAFrame) {
  EXPECT_FALSE(add({}, 7, 1));
  EXPECT_TRUE(add({}, 8, 1.5));
  EXPECT_EQ(take(1.5), 2u);
  EXPECT_TRUE(add({.frame = 8}, std::nullopt, 1.6));
  EXPECT_EQ(take(1.6), 1u);
}

TEST_F(ResultGroupTest, UnitsOfAStepWaitForEachOther) {
  const auto unit = [&](std::optional<uint32_t> next, double ms) {
    msg::Stepped stepped;
    stepped.number = 9;
    return group_.add(
        {0, false, stepped}, [next] { return next; }, at(ms));
  };
  EXPECT_FALSE(unit(9, 1));
  EXPECT_FALSE(unit(9, 2));
  EXPECT_TRUE(unit(10, 3)) << "a frame comes next";
  EXPECT_EQ(take(3), 3u);
}

TEST_F(ResultGroupTest, UrgentResultsAndThoseOfLongTasksDoNotWait) {
  EXPECT_TRUE(add({.urgent = true}, 7, 1));
  EXPECT_EQ(take(1), 1u);
  EXPECT_TRUE(add({.took = 20}, 7, 2));
  EXPECT_EQ(take(2), 1u);
}

TEST_F(ResultGroupTest, IsCalledForOnceUntilItIsTaken) {
  EXPECT_TRUE(add({}, 7, 5));
  EXPECT_FALSE(add({}, 7, 6));
  EXPECT_FALSE(add({}, std::nullopt, 7));
  EXPECT_EQ(take(8), 3u);
  EXPECT_EQ(take(8), 0u);
  EXPECT_TRUE(add({}, std::nullopt, 9));
}

// A worker sees that a task is there; another one finishes that task before the first has added its
// result, which nobody would then take along.
TEST_F(ResultGroupTest, NoResultIsLeftBehindByATaskThatItReliedOn) {
  std::latch asked(1);
  std::thread other([&] {
    asked.wait();
    EXPECT_TRUE(add({}, std::nullopt, 2));
    EXPECT_EQ(take(2), 2u);
  });
  const auto next = [&] {
    asked.count_down();
    std::this_thread::sleep_for(milliseconds(50));
    return std::optional(7u);
  };
  EXPECT_FALSE(group_.add(resultOf({}), next, at(1)));
  other.join();
}

}  // namespace
}  // namespace ninefold
