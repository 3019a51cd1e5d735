// What a frame may cost while something moves: on modelled clusters that are faster, slower, or
// change.
#include "master/running/motion_quality.h"

#include <gtest/gtest.h>

#include <vector>

namespace ninefold {
namespace {

constexpr Duration kTarget = milliseconds(100);

// Time of a frame where a full one takes `full` and each has an overhead that no step saves.
Duration timeOf(Quality q, double full, double overhead = 0.004) {
  return fromSeconds(overhead + full * MotionQuality::cost(q));
}

TEST(MotionQuality, AGestureThatFollowsARestKeepsTheTargetFromItsFirstFrame) {
  for (const double full : {0.02, 0.09, 0.15, 0.4, 1.0, 2.5}) {
    MotionQuality quality(kTarget);
    for (int i = 0; i < 10; ++i) quality.took({}, timeOf({}, full));
    quality.begin();
    for (int i = 0; i < 40; ++i) {
      const Duration time = timeOf(quality.current(), full);
      EXPECT_LE(time, kTarget) << full << " s, frame " << i;
      quality.took(quality.current(), time);
    }
  }
}

TEST(MotionQuality, AFastClusterLosesNothing) {
  MotionQuality quality(kTarget);
  quality.took({}, milliseconds(60));
  quality.begin();
  EXPECT_EQ(quality.current(), Quality{});
  EXPECT_EQ(MotionQuality::describe(quality.current()), "");
}

TEST(MotionQuality, SizeFallsToFiveSixteenthsBeforeTheLightIsThinned) {
  for (double full = 0.05; full < 20; full *= 1.1) {
    MotionQuality quality(kTarget);
    quality.took({}, fromSeconds(full));
    quality.begin();
    if (quality.current().light > 0) {
      EXPECT_LE(MotionQuality::kSizes.at(static_cast<size_t>(quality.current().size)), 0.3125);
    }
  }
}

TEST(MotionQuality, TheLightStaysWithinAGestureWhateverTheClockSays) {
  MotionQuality quality(kTarget);
  quality.took({}, milliseconds(700));
  quality.begin();
  const int light = quality.current().light;
  for (const double full : {0.7, 3.0, 0.05, 8.0, 0.01})
    for (int i = 0; i < 10; ++i) {
      quality.took(quality.current(), timeOf(quality.current(), full));
      EXPECT_EQ(quality.current().light, light);
    }
}

TEST(MotionQuality, FollowsAClusterThatSlowsDownAndRecovers) {
  MotionQuality quality(kTarget);
  quality.took({}, milliseconds(150));
  quality.begin();
  const Quality before = quality.current();
  for (int i = 0; i < 10; ++i) quality.took(quality.current(), timeOf(quality.current(), 0.6));
  const Quality slow = quality.current();
  EXPECT_GT(slow.size, before.size);
  EXPECT_LE(timeOf(quality.current(), 0.6), kTarget);
  for (int i = 0; i < 40; ++i) quality.took(quality.current(), timeOf(quality.current(), 0.15));
  EXPECT_LT(quality.current().size, slow.size);
  EXPECT_LE(quality.current().size, before.size + 1) << "what no step saves counts, too";
}

// None is so late that it alone calls for a smaller one, but half of them are late.
TEST(MotionQuality, FramesThatNeedAllOfTheTargetGetSmaller) {
  MotionQuality quality(kTarget);
  quality.took({}, milliseconds(79));
  quality.begin();
  EXPECT_EQ(quality.current(), Quality{});
  for (int i = 0; i < 10 && quality.current().size == 0; ++i)
    quality.took(Quality{}, milliseconds(i % 2 == 0 ? 90 : 108));
  EXPECT_EQ(quality.current().size, 1);
}

TEST(MotionQuality, OneStallCostsOneStep) {
  MotionQuality quality(kTarget);
  quality.took({}, milliseconds(80));
  quality.begin();
  quality.took({}, milliseconds(400));
  for (int i = 0; i < 10; ++i) {
    EXPECT_LE(quality.current().size, 1);
    quality.took(quality.current(), timeOf(quality.current(), 0.08));
  }
}

TEST(MotionQuality, DoesNotSwingBetweenTwoSizes) {
  for (double full = 0.05; full < 5; full *= 1.07) {
    MotionQuality quality(kTarget);
    quality.took({}, timeOf({}, full));
    quality.begin();
    for (int i = 0; i < 20; ++i) quality.took(quality.current(), timeOf(quality.current(), full));
    const Quality settled = quality.current();
    for (int i = 0; i < 50; ++i) {
      quality.took(quality.current(), timeOf(quality.current(), full));
      EXPECT_EQ(quality.current(), settled) << full;
    }
  }
}

TEST(MotionQuality, ADearerStepIsNeverCheaper) {
  for (int size = 1; size < static_cast<int>(MotionQuality::kSizes.size()); ++size)
    for (int light = 0; light < 3; ++light)
      EXPECT_LT(MotionQuality::cost({size, light}), MotionQuality::cost({size - 1, light}));
  EXPECT_EQ(MotionQuality::cost({}), 1);
  EXPECT_EQ(MotionQuality::describe({3, 1}), "1/2 size, 1/2 light");
}

TEST(Scaled, KeepsAtLeastOneOfWhatThereIs) {
  EXPECT_EQ(scaled(0, 0.5), 0);
  EXPECT_EQ(scaled(4, 0.25), 1);
  EXPECT_EQ(scaled(1, 0.25), 1);
  EXPECT_EQ(scaled(640, 0.75), 480);
}

// A step of a method's state goes before each frame. Frames get what it leaves of the target: small
// ones would be no sooner.
TEST(MotionQuality, WhatAFrameWaitedForDoesNotMakeItSmall) {
  MotionQuality quality(milliseconds(100));
  quality.took({}, milliseconds(20), milliseconds(55));
  quality.begin();
  for (int i = 0; i < 20; ++i)
    quality.took(quality.current(), timeOf(quality.current(), 0.02), milliseconds(55));
  EXPECT_EQ(quality.current(), Quality{});
  for (int i = 0; i < 20; ++i)
    quality.took(quality.current(), timeOf(quality.current(), 0.1), milliseconds(55));
  const Quality small = quality.current();
  EXPECT_LT(seconds(timeOf(small, 0.1)), 0.05);
  for (int i = 0; i < 20; ++i) quality.took(quality.current(), timeOf(quality.current(), 0.02));
  EXPECT_EQ(quality.current(), Quality{}) << "nothing to wait for any more";
}

}  // namespace
}  // namespace ninefold
