#include "common/base/command_line.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ninefold {
namespace {

TEST(CommandLine, PairsAreTwoNumbersInRange) {
  EXPECT_EQ(parsePair("size", "640x480", 1, 16384), std::pair(640, 480));
  for (const char* bad : {"", "640", "640x", "x480", "640x480x2", "640 x480", "0x480", "640x-1",
                          "16385x1", "1e3x10", "99999999999x1", "640X480"})
    EXPECT_THROW(parsePair("size", bad, 1, 16384), UsageError) << bad;
}

TEST(CommandLine, NumbersStandBetweenCommas) {
  EXPECT_EQ(parseNumbers("environment", "1"), std::vector<double>{1});
  EXPECT_EQ(parseNumbers("environment", "1,0.5,-2e1"), (std::vector<double>{1, 0.5, -20}));
  for (const char* bad : {"", ",", "1,", ",1", "1,,2", "1;2", "nan", "inf", "1 ", "one", "1e999"})
    EXPECT_THROW(parseNumbers("environment", bad), UsageError) << bad;
}

TEST(CommandLine, WholeNumbersKeepTheirRange) {
  EXPECT_EQ(parseWhole("seed", "18446744073709551615", 0, UINT64_MAX), UINT64_MAX);
  for (const char* bad : {"", "-1", "+1", "1.5", "18446744073709551616", "0x10"})
    EXPECT_THROW(parseWhole("seed", bad, 0, UINT64_MAX), UsageError) << bad;
}

TEST(CommandLine, MessagesNameTheFlagTheValueAndTheRange) {
  try {
    checkRange("bound", 0.0, 1.0, 2.0);
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_STREQ(error.what(), "--bound 0: must be 1 to 2");
  }
  EXPECT_THROW(checkRange("bound", std::nan(""), 0.0, 2.0), UsageError);
}

TEST(CommandLine, FlagsHaveVariables) {
  EXPECT_EQ(variableOfFlag("key-file"), "NINEFOLD_KEY_FILE");
}

}  // namespace
}  // namespace ninefold
