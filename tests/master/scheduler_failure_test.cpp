// What the scheduler does when clients are lost, slow, frozen or wrong, and when views change.
#include "tests/master/scheduler_bench.h"

namespace ninefold {
namespace {

using Bench = SchedulerBench;
constexpr Duration kLong = SchedulerClient::kSilenceBeforeFirst + milliseconds(1);

TEST(SchedulerFailure, TasksOfALostClientGoBackToTheFrontAtOnce) {
  Bench b;
  b.join(1);
  b.open(0, Bench::grid(20, {1, 1}));
  const std::vector<TaskId> held = b.sent[1];
  b.lose(1);
  EXPECT_EQ(b.scheduler.counts().reissued, held.size());
  b.join(2);
  ASSERT_EQ(b.sent[2].size(), held.size());
  for (const TaskId& task : held) EXPECT_EQ(std::ranges::count(b.sent[2], task), 1);
}

TEST(SchedulerFailure, AFrameSurvivesTheLossOfAllClients) {
  Bench b;
  b.join(1);
  b.open(0, Bench::grid(3));
  b.answer(1);
  b.lose(1);
  b.join(2);
  b.drain();
  EXPECT_EQ(b.scheduler.counts().completedFrames, 1u);
  EXPECT_EQ(b.scheduler.counts().accepted, 27u);
}

TEST(SchedulerFailure, AResultAfterTheLossIsStaleAndNoFaultOfTheClient) {
  Bench b;
  b.join(1);
  b.open(0, Bench::grid(1));
  const TaskId task = b.sent[1].front();
  b.lose(1);
  EXPECT_EQ(b.answer(1, task), Verdict::stale);
  EXPECT_EQ(b.scheduler.counts().droppedStale, 1u);
  EXPECT_EQ(b.scheduler.counts().droppedUnknown, 0u);
  EXPECT_EQ(b.answer(9, task), Verdict::unknown) << "of a client that never was";
  EXPECT_EQ(b.scheduler.tasksLeft(0), 9);
}

TEST(SchedulerFailure, ResultsNobodyAskedForAreUnknown) {
  Bench b;
  b.join(1);
  b.join(2);
  b.open(0, Bench::grid(2));
  const std::vector<TaskId> wrong = {{.frame = 9},
                                     {.frame = 0, .tile = 2},
                                     {.frame = 0, .tile = -1},
                                     {.frame = 0, .tile = 0, .phase = 9},
                                     b.sent[2].front()};
  for (const TaskId& task : wrong) EXPECT_EQ(b.answer(1, task), Verdict::unknown);
  EXPECT_EQ(b.scheduler.counts().droppedUnknown, wrong.size());
  EXPECT_EQ(b.scheduler.counts().accepted, 0u);
}

TEST(SchedulerFailure, ARepeatedResultIsADuplicate) {
  Bench b;
  b.join(1);
  b.open(0, Bench::grid(1, {2, 1}));
  const TaskId first = b.sent[1].at(0), second = b.sent[1].at(1);
  b.answer(1, first);
  EXPECT_EQ(b.answer(1, first), Verdict::duplicate);
  b.answer(1, second);  // completes the frame
  EXPECT_EQ(b.answer(1, first), Verdict::duplicate);
  EXPECT_EQ(b.scheduler.counts().droppedDuplicate, 2u);
}

TEST(SchedulerFailure, AnIdleClientCopiesALateTaskAndTheFirstResultWins) {
  Bench b;
  b.joinKnown({milliseconds(4), milliseconds(4)});
  b.open(1, Bench::grid(1, {1, 1}));
  const ClientId holder = b.sent[1].empty() ? 2 : 1, idle = 3 - holder;
  EXPECT_TRUE(b.sent[idle].empty());
  const uint64_t before = b.scheduler.counts().duplicated;
  b.pass(milliseconds(50));
  ASSERT_EQ(b.sent[idle].size(), 1u);
  EXPECT_EQ(b.scheduler.counts().duplicated, before + 1);
  EXPECT_EQ(b.answer(idle), Verdict::completedFrame);
  EXPECT_EQ(b.answer(holder), Verdict::duplicate);
}

TEST(SchedulerFailure, AQuickClientCopiesWhatASlowOneWouldFinishLater) {
  Bench b;
  b.joinKnown({milliseconds(500)});
  b.open(1, Bench::grid(1, {1, 1}));  // held by the slow client
  b.join(2);
  EXPECT_EQ(b.sent[2].size(), 1u);
}

TEST(SchedulerFailure, ATaskHasAtMostOneCopy) {
  Bench b;
  b.joinKnown({milliseconds(500)});
  b.open(1, Bench::grid(1, {1, 1}));
  for (ClientId c = 2; c < 10; ++c) b.join(c);
  b.pass(milliseconds(900));
  EXPECT_EQ(b.scheduler.counts().duplicated, 1u);
  EXPECT_EQ(b.sentOf(1), 2);
}

TEST(SchedulerFailure, NothingIsCopiedWhileThereIsOtherWork) {
  Bench b;
  b.join(1);
  b.join(2);
  b.open(0, Bench::grid(200));
  for (int i = 0; i < 1000; ++i) b.pass(milliseconds(4)), b.answer(2);  // client 1 sleeps
  EXPECT_EQ(b.scheduler.counts().duplicated, 0u);
}

TEST(SchedulerFailure, AFrozenClientsTasksGoToOthersAndItsLateResultsAreWelcome) {
  Bench b;
  b.join(1);
  b.join(2);
  b.open(0, Bench::grid(40, {1, 1}));
  const std::vector<TaskId> held = b.sent[1];
  ASSERT_GE(held.size(), 2u);
  b.pass(kLong);  // neither has given any result
  EXPECT_EQ(b.scheduler.counts().reissued, 2 * held.size());
  EXPECT_EQ(b.answer(2), Verdict::accepted);  // client 2 is back, client 1 is not
  EXPECT_TRUE(b.scheduler.report(b.now)[0].suspect);
  EXPECT_FALSE(b.scheduler.report(b.now)[1].suspect);
  for (const TaskId& task : held) EXPECT_EQ(std::ranges::count(b.sent[2], task) <= 1, true);
  EXPECT_EQ(b.answer(1), Verdict::accepted);  // still wanted, whoever was asked meanwhile
  EXPECT_FALSE(b.scheduler.report(b.now)[0].suspect);
  b.drain();
  EXPECT_EQ(b.scheduler.counts().completedFrames, 1u);
}

TEST(SchedulerFailure, AFrameCompletesAroundAFrozenClient) {
  Bench b;
  for (ClientId c = 1; c <= 3; ++c) b.join(c);
  b.open(0, Bench::grid(12));
  for (int round = 0; round < 100 && b.scheduler.isOpen(0); ++round) {
    b.drain({1});
    b.pass(milliseconds(100));
  }
  EXPECT_FALSE(b.scheduler.isOpen(0));
  EXPECT_EQ(b.scheduler.counts().accepted, 108u);
}

TEST(SchedulerFailure, ASuspectGetsNothingUntilItIsHeardOfAndThenOneTask) {
  Bench b;
  b.join(1);
  b.open(0, Bench::grid(40, {1, 1}));
  b.pass(kLong);
  b.viewChanged(1);  // whatever it held is void
  b.open(1, Bench::grid(40, {1, 1}));
  EXPECT_TRUE(b.sent[1].empty());
  b.scheduler.clientHeard(1, b.now);
  b.pass(milliseconds(0));
  EXPECT_EQ(b.sent[1].size(), 1u);
  EXPECT_EQ(b.answer(1), Verdict::accepted);
  EXPECT_GT(b.sent[1].size(), 1u);
}

TEST(SchedulerFailure, QuickViewChangesDoNotHideAFrozenClient) {
  Bench b;
  b.joinKnown({milliseconds(4)});
  for (uint32_t frame = 1; frame <= 20; ++frame) {  // 2 seconds, 100 ms each
    b.viewChanged(frame);
    b.open(frame, Bench::grid(40, {1, 1}));
    b.pass(milliseconds(100));
  }
  EXPECT_TRUE(b.scheduler.report(b.now)[0].suspect);
}

TEST(SchedulerFailure, AClientThatWasIdleForLongIsNoSuspect) {
  Bench b;
  b.joinKnown({milliseconds(4)});
  b.pass(std::chrono::hours(1));
  b.open(1, Bench::grid(4));
  EXPECT_FALSE(b.sent[1].empty());
  EXPECT_FALSE(b.scheduler.report(b.now)[0].suspect);
}

TEST(SchedulerFailure, LongTasksAreNoReasonForSuspicion) {
  Bench b;
  b.joinKnown({std::chrono::seconds(3)});
  b.open(1, Bench::grid(4));
  b.pass(std::chrono::seconds(6));
  EXPECT_FALSE(b.scheduler.report(b.now)[0].suspect);
}

TEST(SchedulerFailure, AViewChangeCancelsOlderFramesOnPurpose) {
  Bench b;
  b.join(1);
  b.open(0, Bench::grid(4));
  b.open(1, Bench::grid(4));
  const TaskId old = b.sent[1].front();
  b.answer(1);
  const TaskId second = b.sent[1].front();
  b.viewChanged(1);
  EXPECT_FALSE(b.scheduler.isOpen(0));
  EXPECT_TRUE(b.scheduler.isOpen(1));
  EXPECT_EQ(b.scheduler.counts().cancelledFrames, 1u);
  EXPECT_EQ(b.scheduler.counts().cancelledTasks, 35u);
  EXPECT_EQ(b.answer(1, second), Verdict::stale);
  EXPECT_EQ(b.answer(1, old), Verdict::stale);
  EXPECT_EQ(b.scheduler.counts().droppedStale, 2u);
  EXPECT_GE(b.sentOf(1), 2);  // its credit came back at once
}

TEST(SchedulerFailure, OneSlowTaskDoesNotMakeAClientSlow) {
  Bench b;
  b.join(1);
  b.open(0, TileGrid(2000, 2000, {3, 3}));
  b.scheduler.roundTripMeasured(1, milliseconds(40));
  for (int i = 0; i < 20; ++i) b.answer(1);
  const int before = b.scheduler.report(b.now)[0].window;
  b.answer(1, std::chrono::seconds(100));
  EXPECT_GE(b.scheduler.report(b.now)[0].window, before / 2);
}

TEST(SchedulerFailure, ReportsKeepLostClients) {
  Bench b;
  b.join(1);
  b.open(0, Bench::grid(4));
  b.pass(milliseconds(10));
  b.answer(1, milliseconds(5));
  b.lose(1);
  b.pass(milliseconds(10));
  const std::vector<ClientReport> reports = b.scheduler.report(b.now);
  ASSERT_EQ(reports.size(), 1u);
  EXPECT_TRUE(reports[0].lost);
  EXPECT_EQ(reports[0].tasks, 1u);
  EXPECT_DOUBLE_EQ(reports[0].busyFraction(), 0.5);
}

}  // namespace
}  // namespace ninefold
