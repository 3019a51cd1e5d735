#include "master/output/progress.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "master/options/stop_rule.h"

namespace ninefold {
namespace {

const Time kStart{};

TEST(Progress, LinesCanBeReadByPrograms) {
  Progress p(false, kStart);
  EXPECT_EQ(p.update({.fraction = 0.42, .frames = 27, .of = 64}, kStart + std::chrono::seconds(21)),
            "progress: 42% frame 27 of 64 eta 29 s\n");
  EXPECT_EQ(p.finish({.fraction = 1, .frames = 64, .of = 64}, kStart + std::chrono::seconds(50)),
            "progress: 100% frame 64 of 64 after 50 s\n");
}

// A run that waited 100 s for a client, then went on behind what another had done.
TEST(Progress, TheEndIsForetoldByWhatThisRunDid) {
  Progress p(false, kStart);
  const auto second = [](int n) { return kStart + std::chrono::seconds(n); };
  EXPECT_EQ(
      p.update({.fraction = 0.5, .frames = 50, .begun = second(100), .before = 0.4}, second(102)),
      "progress: 50% frame 50 eta 10 s\n");
  EXPECT_EQ(p.update({.fraction = 0.4, .frames = 40, .before = 0.4}, second(104)),
            "progress: 40% frame 40\n");
}

TEST(Progress, SaysNothingOfTheEndBeforeItCanKnow) {
  Progress p(false, kStart);
  const auto text = p.update({.fraction = 0, .note = "no client yet"}, kStart);
  EXPECT_EQ(text, "progress: 0% frame 0, no client yet\n");
}

TEST(Progress, IsLimitedInRateAndDoesNotRepeatItself) {
  for (const bool terminal : {false, true}) {
    Progress p(terminal, kStart);
    const Duration pause = terminal ? Progress::kRedraw : Progress::kLine;
    EXPECT_TRUE(p.update({.frames = 1}, kStart));
    EXPECT_FALSE(p.update({.frames = 2}, kStart + pause / 2));
    EXPECT_TRUE(p.update({.frames = 2}, kStart + pause));
    EXPECT_FALSE(p.update({.frames = 2}, kStart + 3 * pause));
  }
}

TEST(Progress, ABarIsDrawnOverItselfAndEndsOnAFreshLine) {
  Progress p(true, kStart);
  const std::string half = *p.update({.fraction = 0.5, .frames = 5}, kStart);
  EXPECT_TRUE(half.starts_with("\r["));
  EXPECT_EQ(std::ranges::count(half, '#'), std::ranges::count(half, '.'));
  EXPECT_EQ(half.find('\n'), std::string::npos);
  EXPECT_TRUE(p.finish({.fraction = 1, .frames = 10}, kStart).ends_with("\n"));
}

TEST(StopRule, TheFirstLimitCounts) {
  const StopRule rule{.frames = 100, .seconds = 10, .untilError = 0.01};
  const Duration early = std::chrono::seconds(1), late = std::chrono::seconds(10);
  EXPECT_FALSE(rule.isMet(99, early, 1));
  EXPECT_TRUE(rule.isMet(100, early, 1));
  EXPECT_TRUE(rule.isMet(3, late, 1));
  EXPECT_FALSE(rule.isMet(0, late, 1)) << "a picture needs a frame";
  EXPECT_TRUE(rule.isMet(32, early, 0.01));
}

TEST(StopRule, ErrorIsLookedAtRarely) {
  const StopRule rule{.untilError = 0.5};
  std::vector<int> looks;
  for (int n = 0; n <= 300; ++n)
    if (rule.isMet(n, {}, 0.1)) looks.push_back(n);
  EXPECT_EQ(looks, (std::vector<int>{16, 32, 64, 128, 256}));
}

TEST(StopRule, FractionFollowsTheNearestLimit) {
  EXPECT_DOUBLE_EQ((StopRule{.frames = 64}.fraction(16, {}, 1)), 0.25);
  EXPECT_DOUBLE_EQ((StopRule{.frames = 64}.fraction(99, {}, 1)), 1);
  EXPECT_DOUBLE_EQ((StopRule{.frames = 64, .seconds = 2}.fraction(1, std::chrono::seconds(1), 1)),
                   0.5);
  EXPECT_DOUBLE_EQ((StopRule{.untilError = 0.01}.fraction(16, {}, 0.02)), 0.25);
}

}  // namespace
}  // namespace ninefold
