#include "master/running/step_pace.h"

#include <gtest/gtest.h>

namespace ninefold {
namespace {

TEST(StepPace, BeginsAsItIsTold) {
  EXPECT_EQ(StepPace().units(32, 306, milliseconds(50)), 32u);
  EXPECT_EQ(StepPace().units(500, 306, milliseconds(50)), 306u);
}

// Clients that need 2 ms a unit and 10 ms of latency a step: it ends at (50 - 10)/2 = 20 units.
TEST(StepPace, FindsAsManyUnitsAsTheTimeHasRoomFor) {
  for (const uint32_t first : {1u, 300u}) {
    StepPace pace;
    uint32_t units = pace.units(first, 306, milliseconds(50));
    for (int step = 0; step < 40; ++step) {
      pace.took(units, milliseconds(10 + 2 * static_cast<int>(units)));
      units = pace.units(first, 306, milliseconds(50));
    }
    EXPECT_NEAR(units, 20, 1) << "from " << first;
  }
}

TEST(StepPace, StaysBetweenOneUnitAndAll) {
  StepPace pace;
  pace.took(1, milliseconds(5000));
  EXPECT_EQ(pace.units(32, 306, milliseconds(50)), 1u);
  for (int i = 0; i < 60; ++i) pace.took(306, Duration(0));
  EXPECT_EQ(pace.units(32, 306, milliseconds(50)), 306u);
}

}  // namespace
}  // namespace ninefold
