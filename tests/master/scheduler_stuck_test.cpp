// Clients whose tasks never end, while their heartbeats go on. The deadlines are those at the head
// of scheduler_client.h: 30 s + 0.1 ms a ray before a client's first result, then 10 s + 8 times
// the longest time for a ray of late.
#include "tests/master/scheduler_bench.h"

namespace ninefold {
namespace {

using Bench = SchedulerBench;
using std::chrono::seconds;

// Time passes while all clients are heard of, as a server tells it.
void passWithHeartbeats(Bench& b, Duration time, std::vector<ClientId> clients) {
  for (const Time end = b.now + time; b.now < end;) {
    b.pass(std::min<Duration>(milliseconds(100), end - b.now));
    for (const ClientId c : clients) b.scheduler.clientHeard(c, b.now);
  }
}

TEST(SchedulerStuck, AClientPastItsDeadlineIsStuckAndItsTasksGoElsewhere) {
  Bench b;
  b.joinKnown({milliseconds(4), milliseconds(4)});  // 10 s + 8 x 4 ms with one ray a task
  b.open(1, Bench::grid(40, {1, 1}));
  const std::vector<TaskId> held = b.sent[1];
  ASSERT_FALSE(held.empty());
  b.drain({1});
  passWithHeartbeats(b, seconds(9), {1, 2});
  b.drain({1});
  EXPECT_FALSE(b.scheduler.isOpen(1)) << "client 2 has done it all";
  ASSERT_EQ(b.notes.size(), 0u);
  passWithHeartbeats(b, seconds(2), {1, 2});
  ASSERT_EQ(b.notes.size(), 1u);
  EXPECT_EQ(b.notes[0].client, 1u);
  EXPECT_FALSE(b.notes[0].isBack);
  EXPECT_EQ(b.notes[0].task.task, held.front());
  EXPECT_GE(b.notes[0].time, seconds(10));
  EXPECT_TRUE(b.scheduler.report(b.now)[0].stuck);
  EXPECT_EQ(b.scheduler.counts().clientsStuck, 1u);
  EXPECT_FALSE(b.scheduler.allAreStuck());

  b.open(2, Bench::grid(40, {1, 1}));
  passWithHeartbeats(b, seconds(100), {1, 2});
  EXPECT_EQ(b.sent[1], held) << "it gets no more";
  EXPECT_EQ(b.notes.size(), 2u) << "client 2 held its tasks of frame 2 for 100 s";
  EXPECT_TRUE(b.scheduler.allAreStuck());
}

TEST(SchedulerStuck, ItsLateResultMakesItAClientLikeAnyOtherAndDoublesItsDeadline) {
  Bench b;
  b.joinKnown({milliseconds(4)});
  b.open(1, Bench::grid(40, {1, 1}));
  passWithHeartbeats(b, seconds(60), {1});
  ASSERT_EQ(b.notes.size(), 1u);
  b.answer(1, seconds(60));
  ASSERT_EQ(b.notes.size(), 2u);
  EXPECT_TRUE(b.notes[1].isBack);
  EXPECT_NEAR(ninefold::seconds(b.notes[1].time), 50, 0.5);
  EXPECT_FALSE(b.scheduler.report(b.now)[0].stuck);
  EXPECT_EQ(b.scheduler.report(b.now)[0].timesStuck, 1u);
  // The late result counts as twice the 10.032 s that were allowed: 10 s + 2 x 10.032 s from now
  // on.
  passWithHeartbeats(b, seconds(30), {1});
  EXPECT_EQ(b.notes.size(), 2u);
  passWithHeartbeats(b, milliseconds(300), {1});
  EXPECT_EQ(b.notes.size(), 3u);
}

TEST(SchedulerStuck, TheFirstTasksMayTakeLongAndLongerTheMoreRaysTheyHave) {
  for (const double rays : {1.0, 1e6}) {
    Bench b;
    b.join(1);
    b.open(0, Bench::grid(4), 0, {.rays = rays});
    passWithHeartbeats(b, seconds(30) + fromSeconds(1e-4 * rays) - milliseconds(100), {1});
    EXPECT_TRUE(b.notes.empty());
    passWithHeartbeats(b, milliseconds(300), {1});
    EXPECT_EQ(b.notes.size(), 1u);
  }
}

TEST(SchedulerStuck, LongTasksMakeLongDeadlines) {
  Bench b;
  b.joinKnown({seconds(5)});  // of one ray
  b.open(1, Bench::grid(4, {1, 1}), 0, {.rays = 3});
  passWithHeartbeats(b, seconds(10 + 8 * 3 * 5) - milliseconds(100), {1});
  EXPECT_TRUE(b.notes.empty());
  passWithHeartbeats(b, milliseconds(300), {1});
  EXPECT_EQ(b.notes.size(), 1u);
}

TEST(SchedulerStuck, ALightSetThatTakesLongIsAllowedForLongAfterItWasMade) {
  Bench b;
  b.join(1);
  b.open(0, Bench::grid(1000, {1, 1}));
  const auto first = b.sent[1].front();
  std::erase(b.sent[1], first);
  b.scheduler.resultArrived(1, first, {seconds(7), true}, b.now);
  for (int i = 0; i < 900; ++i) b.answer(1, milliseconds(4));  // s is 4 ms again, l is still 7 s
  passWithHeartbeats(b, seconds(10 + 8 * 7) - milliseconds(100), {1});
  EXPECT_TRUE(b.notes.empty());
  passWithHeartbeats(b, milliseconds(400), {1});
  EXPECT_EQ(b.notes.size(), 1u);
}

TEST(SchedulerStuck, ASceneThatTakesLongToBuildMayTakeThatAgainAfterAnEdit) {
  Bench b;
  b.scheduler.clientJoined(1, 1, b.now, seconds(100));
  b.open(0, Bench::grid(4, {1, 1}));
  passWithHeartbeats(b, seconds(130) - milliseconds(100), {1});
  EXPECT_TRUE(b.notes.empty());
  passWithHeartbeats(b, milliseconds(300), {1});
  EXPECT_EQ(b.notes.size(), 1u);
}

TEST(SchedulerStuck, ATaskWaitsForThoseAheadOfItWithoutFalling) {
  // One task takes 9 s, in time; each behind it has as long from when that one is done.
  Bench b;
  b.joinKnown({milliseconds(4)});
  b.open(1, Bench::grid(6, {1, 1}));
  while (b.scheduler.isOpen(1))
    passWithHeartbeats(b, seconds(9), {1}), b.answer(1, milliseconds(4));
  EXPECT_TRUE(b.notes.empty());
}

TEST(SchedulerStuck, OneThreadOfManyThatDoesNotComeBackIsEnough) {
  Bench b;
  b.join(1, 4);
  b.open(0, Bench::grid(2000, {1, 1}));
  const TaskId hangs = b.sent[1].front();
  for (int i = 0; i < 2000 && b.sent[1].size() > 1; ++i) {
    b.pass(milliseconds(20));
    const auto other = std::ranges::find_if(b.sent[1], [&](auto& t) { return !(t == hangs); });
    b.answer(1, TaskId(*other), milliseconds(4));
  }
  ASSERT_EQ(b.notes.size(), 1u) << "its other threads give results all the time";
  EXPECT_EQ(b.notes[0].task.task, hangs);
  EXPECT_EQ(b.sent[1], std::vector<TaskId>{hangs}) << "what it had went on, and it gets no more";
  EXPECT_TRUE(b.scheduler.allAreStuck());
  b.answer(1, hangs);
  EXPECT_FALSE(b.scheduler.allAreStuck());
  EXPECT_GT(b.sent[1].size(), 1u);
}

TEST(SchedulerStuck, APauseOfTheMasterIsNobodysFault) {
  Bench b;
  b.joinKnown({milliseconds(4)});
  b.open(1, Bench::grid(40, {1, 1}));
  passWithHeartbeats(b, seconds(5), {1});
  b.now += std::chrono::hours(9);  // the machine slept
  b.scheduler.paused(std::chrono::hours(9));
  b.pass(Duration(0));
  passWithHeartbeats(b, seconds(4), {1});
  EXPECT_TRUE(b.notes.empty());
  passWithHeartbeats(b, seconds(2), {1});
  EXPECT_EQ(b.notes.size(), 1u);
}

TEST(SchedulerStuck, WithItsTasksWithdrawnItIsTriedAgainAfterAWhile) {
  Bench b;
  b.joinKnown({milliseconds(4)});
  b.open(1, Bench::grid(40, {1, 1}));
  passWithHeartbeats(b, seconds(11), {1});
  ASSERT_EQ(b.notes.size(), 1u);
  b.viewChanged(2);
  b.open(2, Bench::grid(40, {1, 1}));
  passWithHeartbeats(b, seconds(5), {1});
  EXPECT_TRUE(b.sent[1].empty()) << "it may still be at work on what was withdrawn";
  passWithHeartbeats(b, seconds(6), {1});
  EXPECT_EQ(b.sent[1].size(), 1u);
  EXPECT_TRUE(b.scheduler.report(b.now)[0].stuck);
  b.answer(1);
  EXPECT_FALSE(b.scheduler.report(b.now)[0].stuck);
  EXPECT_GT(b.sent[1].size(), 1u);
}

TEST(SchedulerStuck, TheReportOfALostClientNamesTheTaskThatItHeldLongest) {
  Bench b;
  b.joinKnown({milliseconds(4)});
  b.open(1, Bench::grid(40, {1, 1}));
  const TaskId oldest = b.sent[1].front();
  passWithHeartbeats(b, seconds(20), {1});
  b.lose(1);
  const ClientReport report = b.scheduler.report(b.now)[0];
  ASSERT_TRUE(report.oldest);
  EXPECT_EQ(report.oldest->task, oldest);
  EXPECT_FALSE(report.stuck);
  EXPECT_EQ(report.timesStuck, 1u);
  EXPECT_FALSE(b.scheduler.allAreStuck()) << "there is nobody";
}

}  // namespace
}  // namespace ninefold
