// The plan of frames at rest: fresh randomization each frame, and two biases that die out faster
// than the noise.
#include "master/running/frame_plan.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ninefold {
namespace {

TEST(FramePlan, EveryFrameHasItsOwnRandomizationAndRotation) {
  FramePlan plan(0.1f, 9, true);
  for (uint32_t i = 0; i < 20; ++i) {
    const FrameKey key = plan.next();
    EXPECT_EQ(key.frame, i);
    EXPECT_EQ(key.randomization, i);
    EXPECT_EQ(key.rotation, i);
  }
  EXPECT_EQ(plan.opened(), 20);
}

TEST(FramePlan, WhoSkipsFramesGoesOnLikeWhoOpenedThem) {
  FramePlan opened(0.1f, 9, true), skipped(0.1f, 9, true);
  for (int i = 0; i < 100; ++i) opened.next();
  skipped.skip(100);
  for (int i = 0; i < 10; ++i) {
    const FrameKey a = opened.next(), b = skipped.next();
    EXPECT_EQ(a.frame, b.frame);
    EXPECT_EQ(a.photonRadius, b.photonRadius) << "to the last bit";
  }
}

// r^2(n) = r^2(1) prod_{i=1}^{n-1} (i + 2/3)/(i + 1), which falls as n^(-1/3).
TEST(FramePlan, PhotonDiscsShrinkWithTheCubeRootOfTheFrames) {
  FramePlan plan(0.2f, 9, true);
  double expected = 0.2 * 0.2;
  float last = 0;
  for (int i = 1; i <= 1000; ++i) {
    // Wider and narrower by the fourth root of 2, by turns.
    last = plan.next().photonRadius * std::pow(2.0f, i % 2 == 1 ? -0.25f : 0.25f);
    ASSERT_NEAR(last, std::sqrt(expected), 1e-6) << "frame " << i;
    expected *= (i + 2.0 / 3) / (i + 1);
  }
  // Gamma(n + 2/3)/(Gamma(5/3) Gamma(n + 1)) tends to n^(-1/3)/Gamma(5/3).
  EXPECT_NEAR(last * last, 0.04 / (std::cbrt(1000.0) * std::tgamma(5.0 / 3)), 0.04 * 1e-3);
}

TEST(FramePlan, NeighboursFadeOnceEveryPixelHasMetAllSets) {
  const FramePlan plan(0.1f, 9, true);
  EXPECT_EQ(plan.neighbourWeight(0), 1.0f);
  EXPECT_EQ(plan.neighbourWeight(8), 1.0f);
  EXPECT_EQ(plan.neighbourWeight(17), 0.5f);
  EXPECT_EQ(plan.neighbourWeight(899), 0.01f);
}

TEST(FramePlan, ThePapersPipelineKeepsBoth) {
  FramePlan plan(0.1f, 9, false);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(plan.next().photonRadius, 0.1f);
  EXPECT_EQ(plan.neighbourWeight(99), 1.0f);
}

}  // namespace
}  // namespace ninefold
