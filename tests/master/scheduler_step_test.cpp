// Steps of a method's state in the scheduler: frames without pixels, under the rules of all work.
#include "tests/master/scheduler_bench.h"

namespace ninefold {
namespace {

class SchedulerStep : public testing::Test {
 protected:
  static constexpr uint32_t kFirst = 40;  // unit

  void openStep(uint32_t number, int units) {
    bench.scheduler.openStep(number, kFirst, units, 100);
    bench.pass(Duration(0));
  }
  SchedulerBench bench;
};

TEST_F(SchedulerStep, UnitsAreHandedOutAndTheLastOneCompletesTheStep) {
  bench.join(1), bench.join(2);
  openStep(0, 5);
  EXPECT_EQ(bench.scheduler.tasksLeft(0), 5);
  EXPECT_EQ(bench.scheduler.openFrames(), 0) << "a step is no frame";
  bench.drain();
  EXPECT_EQ(bench.scheduler.counts().completedSteps, 1u);
  EXPECT_EQ(bench.scheduler.counts().completedUnits, 5u);
  EXPECT_EQ(bench.scheduler.counts().completedFrames, 0u);
  for (const ClientReport& report : bench.scheduler.report(bench.now)) {
    EXPECT_EQ(report.lightSets, 0u) << "units make no light set";
    EXPECT_EQ(report.frames, 0u);
  }
}

TEST_F(SchedulerStep, AClientBeginsWithTheUnitsThatItHadInTheStepBefore) {
  bench.join(1), bench.join(2), bench.join(3);
  const auto firstUnits = [&](uint32_t number) {
    for (auto& [client, tasks] : bench.sent) tasks.clear();
    openStep(number, 300);
    std::vector<int> units;
    for (const auto& [client, tasks] : bench.sent) units.push_back(tasks.at(0).tile);
    bench.drain();
    return units;
  };
  const std::vector<int> begun{int{kFirst}, int{kFirst} + 100, int{kFirst} + 200};
  EXPECT_EQ(firstUnits(0), begun);
  EXPECT_EQ(firstUnits(1), begun);
  EXPECT_EQ(bench.scheduler.counts().completedUnits, 600u);
}

TEST_F(SchedulerStep, AStepBeforeAFrameIsHandedOutFirst) {
  openStep(0, 2);
  bench.open(1, bench.grid(4));
  bench.join(1);
  ASSERT_GE(bench.sent[1].size(), 2u);
  EXPECT_EQ(bench.sent[1][0].frame, 0u);
  EXPECT_EQ(bench.sent[1][1].frame, bench.sent[1].size() > 2 ? 0u : bench.sent[1][1].frame);
}

TEST_F(SchedulerStep, AStepThatYieldsLetsUrgentFramesBeOpenedAndGoFirst) {
  bench.join(1);
  bench.scheduler.openStep(0, kFirst, 300, 100, true);
  bench.pass(Duration(0));
  EXPECT_TRUE(bench.scheduler.wantsFrame());
  bench.open(1, bench.grid(4), 0, {.urgent = true});
  while (bench.sent[1].at(0).frame == 0) bench.answer(1);
  EXPECT_GT(bench.scheduler.tasksLeft(0), 200) << "tasks of the frame before most units";
  bench.drain();
  EXPECT_EQ(bench.scheduler.counts().completedUnits, 300u);
}

TEST_F(SchedulerStep, AChangeOfTheViewLeavesSteps) {
  bench.join(1);
  openStep(0, 3);
  bench.open(1, bench.grid(4));
  bench.viewChanged(2);
  EXPECT_EQ(bench.scheduler.tasksLeft(1), 0);
  EXPECT_EQ(bench.scheduler.tasksLeft(0), 3);
  bench.drain();
  EXPECT_EQ(bench.scheduler.counts().completedSteps, 1u);
}

TEST_F(SchedulerStep, AStepThatIsVoidLeavesFrames) {
  bench.join(1);
  bench.open(0, bench.grid(1));
  openStep(1, 3);
  const int left = bench.scheduler.tasksLeft(0);
  bench.scheduler.stateChanged(2, bench.now);
  bench.pass(Duration(0));
  EXPECT_EQ(bench.scheduler.tasksLeft(1), 0);
  EXPECT_EQ(bench.scheduler.tasksLeft(0), left);
  EXPECT_EQ(bench.scheduler.verdictOn(1, {1, kFirst, 0}), Verdict::stale);
  bench.drain();
  EXPECT_EQ(bench.scheduler.counts().completedFrames, 1u);
  EXPECT_EQ(bench.scheduler.counts().completedSteps, 0u);
}

TEST_F(SchedulerStep, UnitsOfALostClientGoToOthers) {
  bench.join(1);
  openStep(0, 4);
  const auto held = bench.sent[1].size();
  ASSERT_GT(held, 0u);
  bench.join(2);
  bench.lose(1);
  bench.drain();
  EXPECT_EQ(bench.scheduler.counts().completedSteps, 1u);
  EXPECT_GE(bench.scheduler.counts().reissued, 1u);
}

TEST_F(SchedulerStep, UnitsOfASilentClientAreCopiedAndTheSecondResultIsADuplicate) {
  bench.join(1);
  openStep(0, 1);
  const TaskId unit = bench.sent[1].at(0);
  bench.join(2);
  bench.pass(std::chrono::seconds(6));
  ASSERT_FALSE(bench.sent[2].empty());
  EXPECT_EQ(bench.answer(2, unit), Verdict::completedFrame);
  EXPECT_EQ(bench.answer(1, unit), Verdict::duplicate);
}

// Else the credit of who was slower would stay spent for good.
TEST_F(SchedulerStep, TheSecondResultOfAUnitGivesItsCreditBackAfterTheStepIsDone) {
  bench.join(1);
  openStep(0, 1);
  const TaskId unit = bench.sent[1].at(0);
  EXPECT_EQ(unit.tile, static_cast<int>(kFirst));
  bench.join(2);
  bench.pass(std::chrono::seconds(6));
  EXPECT_EQ(bench.answer(2, unit), Verdict::completedFrame);
  EXPECT_EQ(bench.scheduler.openFrames(), 0);
  EXPECT_EQ(bench.answer(1, unit), Verdict::duplicate);
  for (const ClientReport& report : bench.scheduler.report(bench.now))
    EXPECT_EQ(report.inFlight, 0) << report.client;
}

TEST_F(SchedulerStep, ClientsWhoWaitForAStepAskForNoFrameTwice) {
  bench.joinKnown({milliseconds(4), milliseconds(4)});
  openStep(10, 1);
  EXPECT_TRUE(bench.scheduler.wantsFrame()) << "there is credit that one unit cannot use";
  bench.open(11, bench.grid(20));
  EXPECT_FALSE(bench.scheduler.wantsFrame());
}

}  // namespace
}  // namespace ninefold
