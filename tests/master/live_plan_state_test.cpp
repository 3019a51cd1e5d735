// What a session opens whose method has a state: steps of six units at rest, of two in motion
// (state check), and frames that wait for them.
#include <gtest/gtest.h>

#include "master/running/live_plan.h"

namespace ninefold {
namespace {

class LivePlanState : public testing::Test {
 protected:
  static LivePlan::Setup setup() {
    LivePlan::Setup s;
    s.state.settings.method = Method::stateCheck;
    s.state.settings.width = 64, s.state.settings.height = 48;
    s.sceneRadius = 5;
    return s;
  }
  void pass(Duration time) { now += time; }
  std::optional<uint32_t> edit() {
    LiveState state = plan.state();
    ++state.scene;
    return plan.change(state, now);
  }
  StepOrder step() {
    const auto step = plan.nextStep(now);
    EXPECT_TRUE(step);
    return step.value_or(StepOrder{});
  }
  LiveFrame frame() {
    const auto frame = plan.next(now);
    EXPECT_TRUE(frame);
    return frame.value_or(LiveFrame{});
  }
  void finish(const LiveFrame& frame) { EXPECT_TRUE(plan.completed(frame.order.key.frame, now)); }
  // A picture at rest is there, and nothing is under way. Each step took so long.
  uint32_t rest(Duration time = {}) {
    const StepOrder made = step();
    pass(time);
    plan.stepDone(made.key, now);
    const StepOrder next = step();
    pass(time);
    finish(frame());
    plan.stepDone(next.key, now);
    return next.key.to;
  }

  // Groups of photons, and a picture at rest: 306 units at 1 ms.
  void pace(std::optional<Duration> stepTime = {}) {
    LivePlan::Setup paced = setup();
    paced.state.settings.method = Method::selective;
    paced.stepTime = stepTime;
    plan = LivePlan(paced, now);
    rest(milliseconds(306));
  }

  Time now = Time(std::chrono::hours(1));
  LivePlan plan{setup(), now};
};

TEST_F(LivePlanState, AFrameIsOpenedWhenItsStateIsThere) {
  EXPECT_FALSE(plan.next(now));
  const StepOrder first = step();
  EXPECT_EQ(first.key.units, 6u);
  EXPECT_FALSE(plan.next(now));
  plan.stepDone(first.key, now);
  const StepOrder second = step();
  const LiveFrame lit = frame();
  EXPECT_EQ(lit.order.key.state, first.key.to);
  EXPECT_GT(lit.order.key.frame, second.key.number) << "one count of numbers";
  EXPECT_EQ(lit.order.job, second.job);
  EXPECT_EQ(lit.rested, 0);
}

TEST_F(LivePlanState, AnEditIsShownByTheLatestStateWhileASmallStepFollowsIt) {
  const uint32_t latest = rest();
  edit();
  const LiveFrame lit = frame();
  EXPECT_TRUE(lit.moving);
  EXPECT_EQ(lit.order.key.state, latest);
  const StepOrder small = step();
  EXPECT_EQ(small.key.units, 2u);
  EXPECT_EQ(small.key.from, latest);
  EXPECT_EQ(small.scene, lit.order.scene) << "of the scene as it is now";
  EXPECT_EQ(small.key.randomization, 0u);
  finish(lit);
  plan.stepDone(small.key, now);
  edit();
  EXPECT_EQ(frame().order.key.state, small.key.to);
}

TEST_F(LivePlanState, ACameraAloneNeedsNoStep) {
  const uint32_t latest = rest();
  LiveState state = plan.state();
  state.settings.camera.eye.x += 1;
  plan.change(state, now);
  EXPECT_FALSE(plan.nextStep(now));
  EXPECT_EQ(frame().order.key.state, latest);
}

TEST_F(LivePlanState, APictureThatComesToRestHasAStateOfItsScene) {
  rest();
  edit();
  const LiveFrame last = frame();
  const StepOrder small = step();
  finish(last);
  pass(LivePlan::kSettle);
  EXPECT_FALSE(plan.next(now)) << "it rests, and its state is not there";
  EXPECT_FALSE(plan.isMoving());
  EXPECT_FALSE(plan.nextStep(now)) << "the small step is under way";
  plan.stepDone(small.key, now);
  const StepOrder all = step();
  EXPECT_EQ(all.key.units, 6u);
  EXPECT_FALSE(plan.next(now));
  plan.stepDone(all.key, now);
  const LiveFrame first = frame();
  EXPECT_FALSE(first.moving);
  EXPECT_EQ(first.rested, 0);
  EXPECT_EQ(first.order.key.state, all.key.to);
}

// The hand is still, and the method's state is not yet that of the scene: each step shows.
TEST_F(LivePlanState, AStateThatCatchesUpIsShownStepByStep) {
  rest();
  edit();
  finish(frame());
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(plan.next(now)) << "nothing is new";
    const StepOrder small = step();
    plan.stepDone(small.key, now);
    const LiveFrame shown = frame();
    EXPECT_TRUE(shown.moving);
    EXPECT_EQ(shown.order.key.state, small.key.to);
    finish(shown);
  }
  EXPECT_FALSE(plan.nextStep(now)) << "all of it is new";
  pass(LivePlan::kSettle);
  EXPECT_FALSE(plan.next(now)) << "rest has a state of its own";
  plan.stepDone(step().key, now);
  EXPECT_FALSE(frame().moving);
}

// The step for the next frame at rest is open when a hand takes hold of something.
TEST_F(LivePlanState, AnEditVoidsAStepOfAllThatShowsTheSceneBefore) {
  plan.stepDone(step().key, now);
  const StepOrder next = step();
  finish(frame());
  edit();
  const auto voided = plan.takeVoidSteps();
  ASSERT_TRUE(voided);
  EXPECT_GT(*voided, next.key.number);
  finish(frame());
  const StepOrder small = step();
  EXPECT_EQ(small.key.units, 2u);
  plan.stepDone(next.key, now);  // its last unit came all the same
  plan.stepDone(small.key, now);
  EXPECT_EQ(frame().order.key.state, small.key.to);
}

TEST_F(LivePlanState, AFrameHasTheLightOfWhatItShowsIfTheFirstStepIsQuick) {
  pace();
  edit();
  const StepOrder all = step();
  pass(milliseconds(20));
  EXPECT_FALSE(plan.next(now)) << "it waits for the step";
  plan.stepDone(all.key, now);
  const LiveFrame lit = frame();
  EXPECT_EQ(lit.order.key.state, all.key.to);
  finish(lit);
  edit();
  EXPECT_TRUE(plan.next(now)) << "later frames wait for none";
  EXPECT_FALSE(step().yields);
}

// A gesture's first step is one of all: 306 units, at 1 ms at rest. What is slow is void, and steps
// go beside frames afterwards.
TEST_F(LivePlanState, AFrameWaitsForAStepNoLongerThanItsOwnTime) {
  pace();
  edit();
  const StepOrder all = step();
  EXPECT_EQ(all.key.units, 306u);
  EXPECT_TRUE(all.yields);
  pass(milliseconds(99));
  EXPECT_FALSE(plan.next(now));
  EXPECT_FALSE(plan.takeVoidSteps());
  pass(milliseconds(1));
  const LiveFrame shown = frame();
  EXPECT_EQ(shown.order.key.state, all.key.from);
  const auto voided = plan.takeVoidSteps();
  ASSERT_TRUE(voided);
  EXPECT_GT(*voided, all.key.number);
  EXPECT_FALSE(plan.stepDone(all.key, now)) << "its last units came all the same";
  const StepOrder beside = step();
  EXPECT_EQ(beside.key.units, 50u) << "half of 100 ms";
  EXPECT_FALSE(beside.yields);
  EXPECT_GE(beside.key.number, *voided);
  finish(shown);
  edit();
  EXPECT_TRUE(plan.next(now)) << "frames of this gesture wait no more";
}

// Edits come faster than the step is done: it is void all the same.
TEST_F(LivePlanState, AFirstStepIsVoidWhateverWasChangedSince) {
  pace();
  edit();
  step();
  for (int i = 0; i < 6; ++i) {
    pass(milliseconds(16));
    edit();
    EXPECT_FALSE(plan.next(now));
    EXPECT_FALSE(plan.nextStep(now)) << "one at a time";
  }
  pass(milliseconds(4));
  EXPECT_TRUE(plan.next(now));
  EXPECT_TRUE(plan.takeVoidSteps());
  EXPECT_TRUE(plan.nextStep(now));
}

TEST_F(LivePlanState, ACameraThatMovesWaitsForNoStepAtRest) {
  pace();
  step();  // of the next frame at rest
  LiveState state = plan.state();
  state.settings.camera.eye.x += 1;
  plan.change(state, now);
  EXPECT_TRUE(plan.next(now));
}

TEST_F(LivePlanState, PacedStepsTakeTheTimeThatIsAskedFor) {
  pace(milliseconds(200));
  edit();
  finish(frame());
  EXPECT_EQ(step().key.units, 200u);
  edit();
  EXPECT_TRUE(plan.next(now)) << "no frame waits for it";
}

TEST_F(LivePlanState, StepsThatAreDoneAreTold) {
  rest();
  edit();
  finish(frame());
  const StepOrder small = step();
  const Time opened = now;
  pass(milliseconds(30));
  const auto told = plan.stepDone(small.key, now);
  ASSERT_TRUE(told);
  EXPECT_EQ(told->key, small.key);
  EXPECT_EQ(told->key.units, small.key.units);
  EXPECT_TRUE(told->moving);
  EXPECT_EQ(told->opened, opened);
  EXPECT_EQ(told->done, now);
  EXPECT_FALSE(plan.stepDone({small.key.number + 1}, now)) << "no such step is open";
}

TEST_F(LivePlanState, OtherSettingsOfTheMethodVoidOpenSteps) {
  step();
  LiveState state = plan.state();
  state.settings.seed += 1;
  plan.change(state, now);
  const auto voided = plan.takeVoidSteps();
  ASSERT_TRUE(voided);
  EXPECT_FALSE(plan.takeVoidSteps());
  const StepOrder fresh = step();
  EXPECT_GE(fresh.key.number, *voided);
  EXPECT_EQ(fresh.key.from, 0u);
}

TEST_F(LivePlanState, AMethodWithoutAStateHasNone) {
  const StepOrder open = step();
  LiveState state = plan.state();
  state.settings.method = Method::instantRadiosity;
  plan.change(state, now);
  EXPECT_TRUE(plan.takeVoidSteps());
  plan.stepDone(open.key, now);
  EXPECT_FALSE(plan.nextStep(now));
  EXPECT_EQ(frame().order.key.state, 0u);
}

TEST_F(LivePlanState, FramesThatCannotBeRenderedTakeTheirStepsWithThem) {
  step();
  plan.giveUp();
  const StepOrder again = step();
  plan.stepDone(again.key, now);
  EXPECT_EQ(frame().order.key.state, again.key.to);
}

}  // namespace
}  // namespace ninefold
