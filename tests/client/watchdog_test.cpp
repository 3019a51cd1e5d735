// A task that does not end is told of once, by its own words; one that ends in time never is.
#include "client/watchdog.h"

#include <gtest/gtest.h>

#include <future>

namespace ninefold {
namespace {

using std::chrono::seconds;

std::function<std::string()> named(const char* name) {
  return [name] { return std::string(name); };
}

TEST(TaskClock, CountsEachTaskFromItsOwnBeginning) {
  TaskClock clock(2);
  clock.begin(0, seconds(10), named("a"));
  EXPECT_EQ(clock.pass(seconds(6)), nullptr);
  clock.begin(1, seconds(10), named("b"));
  EXPECT_EQ(clock.pass(seconds(4)), nullptr) << "10 s are within 10 s";
  const TaskClock::AtWork* over = clock.pass(seconds(1));
  ASSERT_NE(over, nullptr);
  EXPECT_EQ(over->describe(), "a");
  EXPECT_EQ(over->spent, seconds(11));
}

TEST(TaskClock, ATaskThatEndedIsForgottenAndTheNextCountsAnew) {
  TaskClock clock(1);
  clock.begin(0, seconds(10), named("a"));
  clock.pass(seconds(9));
  clock.end(0);
  EXPECT_EQ(clock.pass(seconds(100)), nullptr);
  clock.begin(0, seconds(10), named("b"));
  EXPECT_EQ(clock.pass(seconds(9)), nullptr);
}

TEST(Watchdog, TellsOfATaskThatDoesNotEnd) {
  std::promise<std::string> told;
  Watchdog dog(2, milliseconds(100), [&](const std::string& task, Duration time) {
    EXPECT_GE(time, milliseconds(200));
    told.set_value(task);
  });
  dog.begin(0, milliseconds(100), named("quick"));
  dog.end(0);
  dog.begin(1, milliseconds(100), named("hangs"));
  auto task = told.get_future();
  ASSERT_EQ(task.wait_for(seconds(30)), std::future_status::ready);
  EXPECT_EQ(task.get(), "hangs");
}

}  // namespace
}  // namespace ninefold
