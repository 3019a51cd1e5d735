// The verdict of a trial, of units whose errors and costs are known. Side m sees pixel p in half of
// the units as 1 + a_m and in half as 1 - a_m. Of U units the variance is a_m^2 U/(U - 1), so that
//
//   e_m = a_m^2 U/(U - 1) / 1.01
//
// With K = 9 sets, P pixels, no rays of sets and r rays a pixel, c_m = P (r_m + 5).
#include "common/scene/method_trial.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/base/error.h"
#include "common/scene/methods.h"

namespace ninefold {
namespace {

constexpr size_t kPixels = 100;
constexpr uint32_t kUnits = 20;
constexpr float kRays = 5;

struct Trial {
  float amplitude[2] = {0.1f, 0.1f};
  float pixelRays[2] = {kRays, kRays};
  float setRays[2] = {0, 0};
  float pixels = 1000;

  std::vector<TrialUnit> units() const {
    std::vector<TrialUnit> all(kUnits);
    for (uint32_t u = 0; u < kUnits; ++u) {
      all[u].sets = 9, all[u].pixels = pixels;
      for (size_t m = 0; m < 2; ++m) {
        TrialUnit::Side& side = all[u].sides[m];
        side.setRays = setRays[m], side.pixelRays = pixelRays[m];
        side.radiance.assign(kPixels, 1 + (u % 2 == 0 ? amplitude[m] : -amplitude[m]));
      }
    }
    return all;
  }
};

TEST(MethodTrial, ErrorsAndCostsAreThoseOfTheUnits) {
  Trial t;
  t.amplitude[1] = 0.2f, t.setRays[1] = 100;
  const Verdict verdict = judge(t.units());
  const double n = kUnits;
  EXPECT_NEAR(verdict.sides[0].error, 0.01 * n / (n - 1) / 1.01, 1e-6);
  EXPECT_NEAR(verdict.sides[1].error, 0.04 * n / (n - 1) / 1.01, 1e-6);
  EXPECT_NEAR(verdict.sides[0].cost, 1000 * (kRays + 5), 1e-6);
  EXPECT_NEAR(verdict.sides[1].cost, 1000 * (kRays + 5) + 2 * 9 * 100, 1e-6);
  EXPECT_EQ(verdict.sides[0].dark, 0);
}

// 1.5 times the squared error at the same cost.
TEST(MethodTrial, TheFirstIsTakenUnlessTheSecondIsClearlyBetter) {
  Trial t;
  EXPECT_EQ(judge(t.units()).chosen, 0u);
  t.amplitude[0] = 0.1f * std::sqrt(1.45f);
  EXPECT_EQ(judge(t.units()).chosen, 0u);
  t.amplitude[0] = 0.1f * std::sqrt(1.55f);
  EXPECT_EQ(judge(t.units()).chosen, 1u);
  t.pixelRays[1] = kRays + 2;  // 1.2 times the cost
  EXPECT_EQ(judge(t.units()).chosen, 0u);
}

// Sets count less the larger the picture is.
TEST(MethodTrial, DearSetsAreForLargePictures) {
  Trial t;
  t.amplitude[0] = 0.2f, t.setRays[1] = 10000;
  EXPECT_EQ(judge(t.units()).chosen, 0u);
  t.pixels = 100000;
  EXPECT_EQ(judge(t.units()).chosen, 1u);
}

TEST(MethodTrial, LightThatOneFindsInNoSetDecides) {
  Trial t;
  t.amplitude[1] = 0.9f;
  auto units = t.units();
  EXPECT_EQ(judge(units).chosen, 0u);
  for (TrialUnit& unit : units)
    for (size_t p = 0; p < kPixels / 10; ++p) unit.sides[0].radiance[p] = 0;
  EXPECT_NEAR(judge(units).sides[0].dark, 0.1, 1e-9);
  EXPECT_EQ(judge(units).chosen, 1u);
  for (TrialUnit& unit : units) std::swap(unit.sides[0].radiance, unit.sides[1].radiance);
  EXPECT_EQ(judge(units).chosen, 0u);
}

TEST(MethodTrial, SpotsInFewPixelsDoNotDecide) {
  Trial t;
  t.amplitude[0] = 0.2f;
  auto units = t.units();
  EXPECT_EQ(judge(units).chosen, 1u);
  for (size_t p = 0; p < kPixels / 25; ++p) units[0].sides[1].radiance[p] = 30;
  EXPECT_EQ(judge(units).chosen, 1u);
}

TEST(MethodTrial, WithoutLightOrUnitsItIsTheFirst) {
  EXPECT_EQ(judge({}).chosen, 0u);
  auto units = Trial{}.units();
  for (TrialUnit& unit : units)
    for (TrialUnit::Side& side : unit.sides) side.radiance.assign(kPixels, 0);
  EXPECT_EQ(judge(units).chosen, 0u);
}

StatePages pagesOf(const std::vector<TrialUnit>& units) {
  StatePages pages;
  for (uint32_t u = 0; u < units.size(); ++u) pages.apply({toRecord(u, units[u])});
  return pages;
}

TEST(MethodTrial, PagesTellWhatUnitsTell) {
  Trial t;
  t.amplitude[0] = 0.3f, t.setRays[1] = 10;
  const Verdict direct = judge(t.units()), read = verdictOf(pagesOf(t.units()));
  EXPECT_EQ(read.chosen, 1u);
  for (size_t m = 0; m < 2; ++m) {
    EXPECT_EQ(read.sides[m].error, direct.sides[m].error);
    EXPECT_EQ(read.sides[m].cost, direct.sides[m].cost);
  }
  const std::string text = describeTrial(pagesOf(t.units()));
  EXPECT_NE(text.find(factsOf(kTried[1]).name), std::string::npos) << text;
  EXPECT_NE(text.find("9 times its squared error"), std::string::npos) << text;
}

TEST(MethodTrial, ValuesThatAreNoLightCountAsBlack) {
  auto units = Trial{}.units(), black = units;
  for (uint32_t u = 0; u < kUnits; ++u) {
    units[u].sides[1].radiance[0] = std::numeric_limits<float>::quiet_NaN();
    units[u].sides[1].radiance[1] = std::numeric_limits<float>::infinity();
    black[u].sides[1].radiance[0] = black[u].sides[1].radiance[1] = 0;
  }
  EXPECT_EQ(verdictOf(pagesOf(units)).sides[1].error, verdictOf(pagesOf(black)).sides[1].error);
}

TEST(MethodTrial, PagesThatAreNoRecordAreRefused) {
  StatePages pages;
  pages.apply({PageDelta{{0, 0}, Records(7)}});
  EXPECT_THROW(verdictOf(pages), Error);
  pages.apply({PageDelta{{0, 0}, Records(4 * 7)}});
  EXPECT_THROW(verdictOf(pages), Error);
  auto units = Trial{}.units();
  units[1].sides[0].radiance.pop_back(), units[1].sides[1].radiance.pop_back();
  EXPECT_THROW(verdictOf(pagesOf(units)), Error);
}

}  // namespace
}  // namespace ninefold
