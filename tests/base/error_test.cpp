// Errors are one line with a remedy; broken assumptions end the program and say where.
#include "common/base/error.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>

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

TEST(CheckDeathTest, PrintsBothValuesOfAComparison) {
  const int held = 3;
  EXPECT_DEATH(NINEFOLD_CHECK(held == 4), R"(: held == 4 does not hold \(3 and 4\) at )");
  EXPECT_DEATH(NINEFOLD_CHECK(held + 1 < 2), R"(held \+ 1 < 2 does not hold \(4 and 2\))");
  const std::string name = "north";
  EXPECT_DEATH(NINEFOLD_CHECK(name != "north"), R"(\(north and north\))");
  EXPECT_DEATH(NINEFOLD_CHECK((held > 5) == (held > 2)), R"(\(false and true\))");
  const int* nowhere = nullptr;
  EXPECT_DEATH(NINEFOLD_CHECK(nowhere != nullptr), R"(\(null and null\))");
  const std::optional<int> nothing, five = 5;
  EXPECT_DEATH(NINEFOLD_CHECK(nothing == five), R"(\(nothing and 5\))");
  EXPECT_DEATH(NINEFOLD_CHECK(milliseconds(7) <= milliseconds(5)), R"(\(7 and 5\))");
  enum class Kind : uint8_t { one = 1, two };
  EXPECT_DEATH(NINEFOLD_CHECK(Kind::one == Kind::two), R"(\(1 and 2\))");
  struct Odd {
    bool operator==(const Odd&) const { return false; }
  };
  EXPECT_DEATH(NINEFOLD_CHECK(Odd() == Odd()), R"(\(\? and \?\))");
}

TEST(CheckDeathTest, PrintsTheExpressionAloneIfItComparesNothing) {
  const bool added = false;
  EXPECT_DEATH(NINEFOLD_CHECK(added), "error: added does not hold at ");
  EXPECT_DEATH(NINEFOLD_CHECK(!added && 1 > 2), "error: !added && 1 > 2 does not hold at ");
}

// What a mixture of signs would say by the rules of C++ is not what is meant: -1 < 1u is false
// there.
TEST(Check, ComparesIntegersByTheirValue) {
  const int minus = -1;
  const size_t one = 1;
  NINEFOLD_CHECK(minus < one);
  NINEFOLD_CHECK(one > minus);
  NINEFOLD_CHECK(minus != ~size_t{0});
}

TEST(Check, EvaluatesItsSidesOnce) {
  int calls = 0;
  NINEFOLD_CHECK(++calls == 1);
  EXPECT_EQ(calls, 1);
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
