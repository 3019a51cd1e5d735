// Errors are one line with a remedy; broken assumptions end the program and say where.
#include "common/base/error.h"

#include <gtest/gtest.h>

#include "common/base/clock.h"
#include "common/base/counters.h"
#include "common/base/log.h"

namespace ninefold {
namespace {

TEST(Error, CarriesTheFormattedLine) {
  try {
    fail("{}:{}: bad index {}; export the file again", "room.glb", 12, -3);
    FAIL();
  } catch (const Error& e) {
    EXPECT_STREQ(e.what(), "room.glb:12: bad index -3; export the file again");
  }
}

TEST(ErrorDeathTest, BrokenAssumptionNamesTheExpressionAndThePlace) {
  const int clients = 3;
  NINEFOLD_CHECK(clients == 3);
  EXPECT_DEATH(NINEFOLD_CHECK(clients == 4), "clients == 4.*error_test.cpp");
}

TEST(Log, PutsTheProcessNameInFrontAndMarksWarnings) {
  testing::internal::CaptureStderr();
  nameLog("client 2");
  log("{} triangles", 800);
  warn("no light in {}", "room.glb");
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "[client 2] 800 triangles\n[client 2] warning: no light in room.glb\n");
}

TEST(Clock, SecondsAndDurationsConvertBothWays) {
  EXPECT_EQ(fromSeconds(1.5), milliseconds(1500));
  EXPECT_EQ(seconds(milliseconds(250)), 0.25);
}

TEST(RayCounts, AddUpByPurpose) {
  RayCounts sum{1, 2, 3, 4};
  sum += {10, 20, 30, 40};
  EXPECT_EQ(sum.eye, 11u);
  EXPECT_EQ(sum.shadow, 22u);
  EXPECT_EQ(sum.photon, 33u);
  EXPECT_EQ(sum.compensation, 44u);
  EXPECT_EQ(sum.total(), 110u);
}

}  // namespace
}  // namespace ninefold
