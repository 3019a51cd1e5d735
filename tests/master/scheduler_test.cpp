// How the scheduler shares out work while all goes well.
#include "master/scheduling/scheduler.h"

#include "tests/master/scheduler_bench.h"

namespace ninefold {
namespace {

using Bench = SchedulerBench;

TEST(Scheduler, FinishesAFrameWithOneClient) {
  Bench b;
  b.join(1);
  b.open(0, Bench::grid(4));
  Verdict last = Verdict::unknown;
  for (int i = 0; i < 36; ++i) {
    EXPECT_EQ(b.scheduler.tasksLeft(0), 36 - i);
    last = b.answer(1);
    EXPECT_EQ(last, i < 35 ? Verdict::accepted : Verdict::completedFrame);
  }
  EXPECT_FALSE(b.scheduler.isOpen(0));
  EXPECT_EQ(b.scheduler.counts().accepted, 36u);
  EXPECT_EQ(b.scheduler.counts().completedFrames, 1u);
}

TEST(Scheduler, TasksWithoutPixelsDoNotExist) {
  Bench b;
  b.join(1, 64);
  b.open(0, TileGrid(2, 1, {3, 3}));  // two pixels: phases 0 and 1 of one tile
  EXPECT_EQ(b.scheduler.tasksLeft(0), 2);
  EXPECT_EQ(b.sent[1].size(), 2u);
  EXPECT_EQ(b.scheduler.verdictOn(1, {.frame = 0, .tile = 0, .phase = 2}), Verdict::unknown);
}

TEST(Scheduler, AClientThatJoinsInMidFrameGetsWorkAtOnce) {
  Bench b;
  b.join(1);
  b.open(0, Bench::grid(4));
  b.join(2);
  EXPECT_FALSE(b.sent[2].empty());
}

TEST(Scheduler, AClientStaysWithItsLightSetWhileThatHasTasks) {
  Bench b;
  b.join(1);
  b.join(2);
  b.open(0, Bench::grid(10));
  // 10 tasks in each set: two clients on different sets, ten tasks long each.
  std::map<ClientId, std::set<int>> phases;
  for (int i = 0; i < 7; ++i)
    for (const ClientId c : {1u, 2u}) phases[c].insert(b.sent[c].front().phase), b.answer(c);
  EXPECT_EQ(phases[1].size(), 1u);
  EXPECT_EQ(phases[2].size(), 1u);
  EXPECT_NE(phases[1], phases[2]);
}

TEST(Scheduler, InMotionAClientKeepsItsSetsFromFrameToFrame) {
  Bench b;
  for (ClientId c = 1; c <= 9; ++c) b.join(c);
  std::map<ClientId, std::set<int>> first, second;
  const auto play = [&](uint32_t frame, auto& sets) {
    b.open(frame, Bench::grid(2), 7, {.urgent = true});
    for (ClientId c = 1; c <= 9; ++c)
      for (const TaskId& t : b.sent[c]) sets[c].insert(t.phase);
    b.drain();
  };
  play(0, first);
  play(1, second);
  EXPECT_EQ(first, second);
}

// Frame 0 has one light set, client 1 is at it, client 2 has time.
void secondComes(Bench& b, FrameKind kind) {
  b.join(1);
  b.open(0, Bench::grid(20, {1, 1}), 0, kind);
  b.scheduler.openFrame({.frame = 1, .randomization = 1}, Bench::grid(20, {1, 1}), kind);
  b.join(2);
}

TEST(Scheduler, AtRestWhoHasTimeTakesALightSetOfItsOwnInTheNextFrame) {
  Bench b;
  secondComes(b, {});
  ASSERT_FALSE(b.sent[2].empty());
  for (const TaskId& task : b.sent[1]) EXPECT_EQ(task.frame, 0u);
  for (const TaskId& task : b.sent[2]) EXPECT_EQ(task.frame, 1u);
}

TEST(Scheduler, AFrameThatIsUrgentOrWhoseSetsAreFreeIsSharedByAll) {
  for (const FrameKind kind : {FrameKind{.urgent = true}, FrameKind{.freeSets = true}}) {
    Bench b;
    secondComes(b, kind);
    ASSERT_FALSE(b.sent[2].empty());
    for (const TaskId& task : b.sent[2]) EXPECT_EQ(task.frame, 0u);
  }
}

TEST(Scheduler, WantsANextFrameRatherThanThatALightSetIsShared) {
  for (const FrameKind kind : {FrameKind{}, {.urgent = true}, {.freeSets = true}}) {
    Bench b;
    b.join(1);
    b.open(0, Bench::grid(20, {1, 1}), 0, kind);
    b.scheduler.clientJoined(2, 1, b.now);
    EXPECT_EQ(b.scheduler.wantsFrame(), !kind.urgent && !kind.freeSets);
  }
}

// Client 1 sits on its light set of frame 1 while the others do frame after frame: they help before
// they are far ahead.
TEST(Scheduler, TheSlowestIsHelpedBeforeOthersAreFarAhead) {
  Bench b;
  for (ClientId c = 1; c <= 3; ++c) b.join(c);
  uint32_t frame = 0;
  const auto isHelped = [&] { return b.scheduler.tasksLeft(0) == int(b.sent[1].size()); };
  for (; frame < 30 && !isHelped(); ++frame) {
    b.open(frame, Bench::grid(20, {3, 1}), frame);
    b.drain({1});
  }
  EXPECT_TRUE(isHelped());
  EXPECT_LE(frame, 5u);
}

TEST(Scheduler, RotationTurnsPhasesIntoSets) {
  // One client, two tasks of each set, rotation 4: with 1x2 phases a set is the other phase.
  Bench b;
  b.scheduler.openFrame({.frame = 0, .rotation = 1}, Bench::grid(2, {2, 1}));
  b.join(1);
  EXPECT_EQ(b.sent[1].front().phase, 1);  // set 0 comes first
}

TEST(Scheduler, TheNextFrameStartsBeforeTheLastTaskOfThisOneIsBack) {
  Bench b;
  b.join(1);
  b.open(0, Bench::grid(1, {1, 1}));
  EXPECT_TRUE(b.scheduler.wantsFrame());
  b.open(1, Bench::grid(4));
  EXPECT_EQ(b.sentOf(0), 1);
  EXPECT_GE(b.sentOf(1), 1);
}

TEST(Scheduler, TheOldestFrameComesFirst) {
  Bench b;
  b.open(0, Bench::grid(1, {2, 1}));
  b.open(1, Bench::grid(1, {2, 1}));
  b.join(1);
  EXPECT_EQ(b.sent[1].at(0).frame, 0u);
  EXPECT_EQ(b.sent[1].at(1).frame, 0u);
}

TEST(Scheduler, FramesMayCompleteOutOfOrder) {
  Bench b;
  b.join(1);
  b.join(2);
  b.open(0, Bench::grid(1, {1, 1}));  // held by client 1
  b.open(1, Bench::grid(1, {1, 1}));
  EXPECT_EQ(b.answer(2), Verdict::completedFrame);
  EXPECT_TRUE(b.scheduler.isOpen(0));
  EXPECT_FALSE(b.scheduler.isOpen(1));
  EXPECT_EQ(b.answer(1), Verdict::completedFrame);
}

TEST(Scheduler, WantsNoFrameWithoutClientsOrWhileThereIsWork) {
  Bench b;
  EXPECT_FALSE(b.scheduler.wantsFrame());
  b.join(1);
  EXPECT_TRUE(b.scheduler.wantsFrame());
  b.open(0, Bench::grid(10));
  EXPECT_FALSE(b.scheduler.wantsFrame());
}

TEST(Scheduler, CreditIsBoundedAndGrowsWithRoundTripAndSpeed) {
  const auto window = [](int threads, Duration roundTrip, Duration cost) {
    Bench b;
    b.join(1, threads);
    b.scheduler.roundTripMeasured(1, roundTrip);
    b.open(0, TileGrid(8000, 8000, {3, 3}));
    for (int i = 0; i < 50; ++i) b.answer(1, cost);
    EXPECT_LE(b.sent[1].size(), static_cast<size_t>(b.scheduler.report(b.now)[0].window));
    return b.scheduler.report(b.now)[0].window;
  };
  using std::chrono::microseconds;
  // At work; on their way or waiting for others; a group.
  EXPECT_EQ(window(1, microseconds(30), milliseconds(40)), 1 + 1 + 1);
  EXPECT_EQ(window(1, microseconds(30), milliseconds(2)), 1 + 3 + 2);
  EXPECT_EQ(window(8, microseconds(30), milliseconds(4)), 8 + 9 + 8);
  EXPECT_EQ(window(8, microseconds(30), milliseconds(40)), 8 + 1 + 4);
  EXPECT_EQ(window(1, milliseconds(40), milliseconds(4)), 1 + 11 + 1);
  EXPECT_EQ(window(1, milliseconds(40), milliseconds(400)), 1 + 1 + 1);
  EXPECT_LE(window(4, std::chrono::seconds(5), microseconds(50)),
            4 * SchedulerClient::kMaxPerThread);
}

TEST(Scheduler, AClientIsRefilledInGroups) {
  // Of `answers`, those after which tasks are sent.
  const auto refills = [](int threads, Duration cost, int answers) {
    Bench b;
    b.join(1, threads);
    b.open(0, TileGrid(2000, 2000, {3, 3}));
    for (int i = 0; i < 50; ++i) b.answer(1, cost);
    int grew = 0;
    for (int i = 0; i < answers; ++i) {
      const size_t before = b.sent[1].size();
      b.answer(1, cost);
      grew += b.sent[1].size() >= before;
    }
    return grew;
  };
  EXPECT_EQ(refills(8, milliseconds(50), 200), 200 / 4);
  EXPECT_EQ(refills(1, milliseconds(1), 200), 200 / 4);  // as many as one group of results
  EXPECT_EQ(refills(1, milliseconds(50), 200), 200);
}

TEST(Scheduler, ShortSupplyGoesToWhoeverFinishesFirst) {
  Bench b;
  b.joinKnown({milliseconds(100), milliseconds(10)});
  b.open(1, Bench::grid(2, {1, 1}));  // the second task waits less behind the first of client 2
  EXPECT_EQ(b.sent[1].size(), 0u);
  EXPECT_EQ(b.sent[2].size(), 2u);
}

TEST(Scheduler, EqualEventsGiveEqualActions) {
  const auto play = [] {
    Bench b;
    std::vector<TaskId> all;
    for (ClientId c = 1; c <= 5; ++c) b.join(c, 1 + static_cast<int>(c) % 3);
    b.open(0, Bench::grid(6));
    for (int i = 0; i < 30; ++i) {
      const ClientId c = 1 + static_cast<ClientId>(i * 7 % 5);
      if (b.sent[c].empty()) continue;
      all.push_back(b.sent[c].back());
      b.answer(c);
    }
    return all;
  };
  EXPECT_EQ(play(), play());
}

TEST(Scheduler, ExplainsWhereATaskIs) {
  Bench b;
  const auto text = [&](TaskId t) { return b.scheduler.explain(t, b.now); };
  const auto contains = [](const std::string& s, const char* part) {
    return s.find(part) != std::string::npos;
  };
  EXPECT_TRUE(contains(text({.frame = 3}), "not been opened"));
  b.open(0, Bench::grid(2, {1, 1}));
  EXPECT_TRUE(contains(text({.frame = 0, .tile = 1}), "there is no client"));
  EXPECT_TRUE(contains(text({.frame = 0, .tile = 9}), "no such task"));
  b.join(4);
  b.pass(milliseconds(30));
  EXPECT_TRUE(contains(text({.frame = 0, .tile = 0}), "in flight at client 4 for 30 ms"));
  b.answer(4);
  EXPECT_TRUE(contains(text({.frame = 0, .tile = 0}), "done"));
  b.viewChanged(1);
  EXPECT_TRUE(contains(text({.frame = 0, .tile = 1}), "superseded"));
}

// Two tasks, both at the only client; one is answered.
TEST(Scheduler, ExplainsFramesAndClients) {
  Bench b;
  EXPECT_TRUE(b.scheduler.explainFrames(b.now).empty());
  EXPECT_EQ(b.scheduler.explainClient(4, b.now), "gets no tasks");
  b.join(4);
  EXPECT_TRUE(b.scheduler.explainClient(4, b.now).ends_with("; waits: no task is to be had"));
  b.open(0, Bench::grid(2, {1, 1}));
  b.pass(milliseconds(30));
  b.answer(4);
  b.pass(milliseconds(20));
  const std::vector<std::string> frames = b.scheduler.explainFrames(b.now);
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0], "frame 0: 1 of 2 tasks are done, 1 are at clients, 0 wait");
  EXPECT_TRUE(frames[1].starts_with("tile 1 phase 0 of frame 0: in flight at client 4 for 50 ms"))
      << frames[1];
  const std::string client = b.scheduler.explainClient(4, b.now);
  EXPECT_TRUE(client.starts_with("holds 1 tasks, refilled at ")) << client;
  EXPECT_NE(client.find("the oldest is frame 0, tile 1, set 0, at work on it for 20 ms"),
            std::string::npos)
      << client;
}

}  // namespace
}  // namespace ninefold
