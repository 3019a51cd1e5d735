// Which steps are wanted, and which version lights a frame. The method state check has a state of
// six units, of which a step in motion makes two.
#include "master/running/state_plan.h"

#include <gtest/gtest.h>

namespace ninefold {
namespace {

class StatePlanTest : public testing::Test {
 protected:
  StatePlanTest() { settings.method = Method::stateCheck; }
  StatePlan plan() const { return StatePlan(settings); }
  uint32_t all() const { return factsOf(settings.method).state->unitsOfAll(settings); }
  // Opens the next step, if one is wanted.
  std::optional<StepKey> step(StatePlan& plan, bool moving = false,
                              std::optional<int64_t> left = {}) {
    const auto step = plan.nextStep(number, moving, left);
    if (step) ++number;
    return step;
  }

  Settings settings;
  uint32_t number = 0;
};

TEST(StatePlan, MethodsWithoutAStateHaveNoStep) {
  StatePlan plan{Settings{}};
  EXPECT_FALSE(plan.nextStep(0, false, {}));
  EXPECT_EQ(plan.versionOfFrame(false), 0u);
  EXPECT_EQ(plan.versionOfFrame(true), 0u);
}

TEST_F(StatePlanTest, AFrameAtRestWaitsForAStateOfItsOwn) {
  StatePlan p = plan();
  EXPECT_FALSE(p.versionOfFrame(false));
  const auto first = step(p);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->units, all());
  EXPECT_EQ(first->from, 0u);
  EXPECT_FALSE(p.versionOfFrame(false));
  p.done(*first);
  EXPECT_EQ(p.versionOfFrame(false), first->to);
  EXPECT_FALSE(p.versionOfFrame(false)) << "each lights one frame";
}

TEST_F(StatePlanTest, TheNextStepBeginsBeforeTheFrameThatTheLastOneLights) {
  StatePlan p = plan();
  const auto first = step(p);
  EXPECT_FALSE(step(p)) << "one at a time";
  p.done(*first);
  const auto second = step(p);
  ASSERT_TRUE(second);
  EXPECT_NE(second->randomization, first->randomization);
  EXPECT_EQ(second->firstUnit, first->firstUnit + all());
  EXPECT_EQ(p.versionOfFrame(false), first->to);
  p.done(*second);
  const auto third = step(p);
  ASSERT_TRUE(third);
  p.done(*third);
  EXPECT_FALSE(step(p)) << "two versions wait for frames";
}

TEST_F(StatePlanTest, NoStepIsMadeForFramesThatAreNotWanted) {
  StatePlan p = plan();
  const auto first = step(p, false, 1);
  ASSERT_TRUE(first);
  p.done(*first);
  EXPECT_FALSE(step(p, false, 1));
  EXPECT_TRUE(p.versionOfFrame(false));
  EXPECT_FALSE(step(p, false, 0));
}

TEST_F(StatePlanTest, InMotionTheLatestVersionLightsFramesUntilTheSceneIsShown) {
  StatePlan p = plan();
  const auto first = step(p);
  p.done(*first);
  EXPECT_EQ(p.versionOfFrame(true), first->to);
  EXPECT_FALSE(step(p, true)) << "a camera alone moves no light";
  p.change(settings, true);
  uint32_t last = first->to;
  for (uint32_t unit = 0; unit < all(); unit += 2) {
    const auto small = step(p, true);
    ASSERT_TRUE(small) << unit;
    EXPECT_EQ(small->units, 2u);
    EXPECT_EQ(small->from, last);
    EXPECT_EQ(p.versionOfFrame(true), last) << "the frame does not wait for it";
    p.done(*small);
    last = small->to;
  }
  EXPECT_EQ(p.versionOfFrame(true), last);
  EXPECT_FALSE(step(p, true)) << "all of it shows the scene as it is";
}

TEST_F(StatePlanTest, AStepRunsBesideAFrameNotFasterThanFrames) {
  StatePlan p = plan();
  p.done(*step(p));
  p.change(settings, true);
  EXPECT_TRUE(p.versionOfFrame(true));
  const auto small = step(p, true);
  ASSERT_TRUE(small);
  p.done(*small);
  EXPECT_FALSE(step(p, true)) << "no frame since";
  EXPECT_TRUE(p.versionOfFrame(true));
  EXPECT_TRUE(step(p, true));
}

TEST_F(StatePlanTest, WhatWasMadeOfAnOlderSceneLightsNoFrameAtRest) {
  StatePlan p = plan();
  const auto old = step(p);
  p.change(settings, true);
  p.done(*old);
  EXPECT_FALSE(p.versionOfFrame(false));
  const auto fresh = step(p);
  ASSERT_TRUE(fresh);
  p.done(*fresh);
  p.restart();
  EXPECT_FALSE(p.versionOfFrame(false)) << "of a series before";
}

TEST_F(StatePlanTest, ClientsRememberWhatHasRoom) {
  const auto remembers = [&](Method method, int pool) {
    settings.method = method, settings.photonPool = pool;
    return plan().remembers();
  };
  EXPECT_TRUE(remembers(Method::selective, 147456));
  EXPECT_FALSE(remembers(Method::selective, 1 << 20));
  EXPECT_FALSE(remembers(Method::photonMap, 147456));
  EXPECT_FALSE(remembers(Method::instantRadiosity, 147456));
}

TEST_F(StatePlanTest, OtherSettingsVoidTheStepAndTheState) {
  StatePlan p = plan();
  p.done(*step(p));
  const auto under = step(p);
  ASSERT_TRUE(under);
  Settings other = settings;
  other.seed = settings.seed + 1;
  EXPECT_TRUE(p.change(other, false));
  EXPECT_FALSE(p.versionOfFrame(true)) << "nothing is right any more";
  const auto fresh = step(p, true);
  ASSERT_TRUE(fresh);
  EXPECT_EQ(fresh->units, all());
  p.done(*under);  // came too late
  EXPECT_FALSE(p.versionOfFrame(true));
  p.done(*fresh);
  EXPECT_EQ(p.versionOfFrame(true), fresh->to);
}

TEST_F(StatePlanTest, AnotherViewKeepsTheState) {
  StatePlan p = plan();
  p.done(*step(p));
  Settings other = settings;
  other.width = 320, other.camera.eye.x += 1;
  EXPECT_FALSE(p.change(other, false));
  EXPECT_TRUE(p.versionOfFrame(true));
}

// A state that serves all frames of a series: the trial of the method auto.
class TrialPlanTest : public StatePlanTest {
 protected:
  TrialPlanTest() { settings.method = Method::automatic; }
};

TEST_F(TrialPlanTest, AtRestOneStepLightsAllFrames) {
  StatePlan p = plan();
  EXPECT_FALSE(p.versionOfFrame(false));
  const auto trial = step(p);
  ASSERT_TRUE(trial);
  EXPECT_EQ(trial->units, all());
  p.done(*trial);
  for (int frame = 0; frame < 3; ++frame) {
    EXPECT_EQ(p.versionOfFrame(false), trial->to);
    EXPECT_FALSE(step(p));
  }
}

TEST_F(TrialPlanTest, InMotionTheLatestStaysAndTheNextRestTriesAnew) {
  StatePlan p = plan();
  const auto first = step(p);
  p.done(*first);
  Settings other = settings;
  other.camera.eye.x += 1;
  EXPECT_FALSE(p.change(other, true));
  EXPECT_EQ(p.versionOfFrame(true), first->to);
  EXPECT_FALSE(step(p, true)) << "not even after an edit of the scene";
  p.restart();
  EXPECT_FALSE(p.versionOfFrame(false)) << "of another view";
  const auto second = step(p);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->from, 0u);
  EXPECT_EQ(second->firstUnit, 0u) << "what was tried before does not count";
  EXPECT_EQ(p.versionOfFrame(true), first->to) << "if it moves again meanwhile";
  p.done(*second);
  EXPECT_EQ(p.versionOfFrame(false), second->to);
}

TEST_F(TrialPlanTest, MotionAtTheStartWaitsForATrial) {
  StatePlan p = plan();
  EXPECT_FALSE(p.versionOfFrame(true));
  const auto trial = step(p, true);
  ASSERT_TRUE(trial);
  EXPECT_EQ(trial->units, all());
  p.done(*trial);
  EXPECT_EQ(p.versionOfFrame(true), trial->to);
}

TEST_F(StatePlanTest, AStepThatCannotBeDoneIsMadeAgain) {
  StatePlan p = plan();
  ASSERT_TRUE(step(p));
  p.giveUp();
  const auto again = step(p);
  ASSERT_TRUE(again);
  p.done(*again);
  EXPECT_EQ(p.versionOfFrame(false), again->to);
}

// The steps and versions of frames `from`.. of one plan are those of another that went through all.
TEST_F(StatePlanTest, AResumedPlanTakesTheStepsOfOneThatWasNeverEnded) {
  for (const Method method : {Method::stateCheck, Method::photonMap, Method::selective}) {
    settings.method = method;
    StatePlan whole = plan(), resumed = plan();
    uint32_t version = 0;
    for (int i = 0; i < 5; ++i) {
      whole.done(*step(whole));
      version = *whole.versionOfFrame(false);
    }
    const bool isNeeded = isNeededAfterwards(factsOf(method).state);
    EXPECT_EQ(isNeeded, method == Method::stateCheck);
    resumed.resume(5, isNeeded ? version : 0);
    for (int i = 0; i < 3; ++i) {
      const auto a = step(whole), b = step(resumed);
      ASSERT_TRUE(a && b);
      EXPECT_EQ(a->firstUnit, b->firstUnit);
      EXPECT_EQ(a->randomization, b->randomization);
      EXPECT_EQ(a->from == 0, b->from == 0);
      EXPECT_TRUE(!isNeeded || a->from == b->from);
      EXPECT_EQ(a->units, b->units);
      whole.done(*a), resumed.done(*b);
      EXPECT_TRUE(whole.versionOfFrame(false) && resumed.versionOfFrame(false));
    }
  }
}

TEST_F(StatePlanTest, AResumedChoiceIsNotMadeAgain) {
  settings.method = Method::automatic;
  StatePlan p = plan();
  p.resume(5, 1);
  EXPECT_FALSE(step(p));
  EXPECT_EQ(p.versionOfFrame(false), 1u);
}

// Back to version 2 after 6: the next version is 7, made of 2.
TEST_F(StatePlanTest, WhoGoesBackMakesNewVersionsOfTheOldOne) {
  StatePlan p = plan();
  for (int i = 0; i < 6; ++i) p.done(*step(p)), p.versionOfFrame(false);
  p.resume(2, 2);
  const auto next = step(p);
  ASSERT_TRUE(next);
  EXPECT_EQ(next->from, 2u);
  EXPECT_EQ(next->to, 7u);
  EXPECT_EQ(next->randomization, 2u);
}

}  // namespace
}  // namespace ninefold
