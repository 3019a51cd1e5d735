// Results done again by a second client: which tasks, who is believed, what is trusted afterwards.
#include "master/scheduling/verification.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/sampling/hash.h"
#include "tests/master/scheduler_bench.h"
#include "tests/seeds.h"

namespace ninefold {
namespace {

Digest digestOf(int value) {
  Digest digest{};
  digest[0] = static_cast<uint8_t>(value);
  return digest;
}

HeldTask taskOf(uint32_t frame, int tile = 0, bool isStep = false) {
  return {.task = {frame, tile, 0}, .isStep = isStep};
}

constexpr auto kAny = [](const TaskId&) { return true; };

class VerificationTest : public testing::Test {
 protected:
  VerificationTest() { books.begin(7, 1); }
  void join(std::initializer_list<ClientId> clients, const char* pixelClass = "a") {
    for (const ClientId client : clients) books.joined(client, pixelClass);
  }
  void give(ClientId client, uint32_t frame, int value, int tile = 0) {
    books.accepted(client, taskOf(frame, tile), digestOf(value), {});
  }
  // Whether the client was to check something, and gave this.
  bool check(ClientId client, int value) {
    const auto task = books.next(client, kAny);
    if (!task) return false;
    books.given(client, task->task);
    EXPECT_TRUE(books.expects(client, task->task));
    books.answered(client, task->task, digestOf(value));
    return true;
  }
  std::vector<ClientId> wrong() {
    std::vector<ClientId> clients;
    for (const WrongNote& note : books.takeWrong()) clients.push_back(note.client);
    return clients;
  }
  Verification books;
};

TEST_F(VerificationTest, TheChoiceIsAFractionAndAFunctionOfSeedFrameAndTile) {
  Verification a, b, other;
  a.begin(1, 0.1), b.begin(1, 0.1), other.begin(2, 0.1);
  int chosen = 0, alike = 0;
  constexpr int kFrames = 200, kTiles = 100;
  for (uint32_t frame = 0; frame < kFrames; ++frame)
    for (int tile = 0; tile < kTiles; ++tile) {
      const TaskId task{frame, tile, 0};
      chosen += a.isChosen(task);
      alike += a.isChosen(task) && other.isChosen(task);
      EXPECT_EQ(a.isChosen(task), b.isChosen(task));
      EXPECT_EQ(a.isChosen(task), a.isChosen({frame, tile, 5})) << "all phases of a tile";
    }
  // n p +- 5 sqrt(n p (1-p)): by chance outside once in a million.
  EXPECT_NEAR(chosen, 2000, 5 * 42.5);
  EXPECT_NEAR(alike, 200, 5 * 14.1);
  a.begin(1, 1);
  EXPECT_TRUE(a.isChosen({3, 4, 0}));
}

TEST_F(VerificationTest, TwoThatAgreeVouchForAllBefore) {
  join({1, 2});
  give(1, 0, 5), give(2, 0, 5, 1);
  books.mark();
  EXPECT_FALSE(books.isTrusted());
  EXPECT_TRUE(check(2, 5));
  EXPECT_FALSE(books.isTrusted()) << "nobody vouches for client 2 yet";
  EXPECT_TRUE(check(1, 5));
  EXPECT_TRUE(books.isTrusted());
  EXPECT_EQ(books.counts().checked, 2u);
  EXPECT_TRUE(wrong().empty());
}

// Who errs in units alone has many agreements, of tasks.
TEST_F(VerificationTest, TasksDoNotVouchForUnits) {
  join({1, 2});
  books.accepted(1, taskOf(0, 0, true), digestOf(5), {});
  books.drop(1, true);  // it is not checked
  give(1, 1, 5);
  books.mark();
  ASSERT_TRUE(check(2, 5));
  EXPECT_FALSE(books.isTrusted()) << "nobody looked at the unit";
  books.accepted(1, taskOf(2, 0, true), digestOf(6), {});
  ASSERT_TRUE(check(2, 6));
  EXPECT_TRUE(books.isTrusted());
}

// A fault that comes and goes: client 1 is wrong in a twentieth of its results, client 2 checks and
// client 3 settles. What stays wrong is what came before the last agreement, which nobody checked.
// Of the wrong results each is the first that is checked with probability P, so that (1-P)/P come
// before it in the mean; all that stay are among them.
TEST_F(VerificationTest, AFaultNowAndThenLeavesNoMoreThanWhatIsWrongBeforeItIsFound) {
  constexpr int kRuns = 400;
  for (const double fraction : {0.1, 0.3, 1.0}) {
    double left = 0, squares = 0;
    for (int run = 0; run < kRuns; ++run) {
      books = {};
      books.begin(static_cast<uint64_t>(run), fraction);
      join({1, 2, 3});
      int sinceAgreed = 0, stays = 0;
      for (uint32_t frame = 0; wrong().empty(); ++frame) {
        const bool isWrong = hashWords(uint64_t{frame}, static_cast<uint64_t>(run)) % 20 == 0;
        sinceAgreed += isWrong ? 1 : 0;
        give(1, frame, isWrong ? 6 : 5);
        books.mark();
        while (check(2, 5) || check(3, 5)) {
        }
        if (books.isTrusted()) stays += std::exchange(sinceAgreed, 0);
      }
      left += stays, squares += stays * stays;
    }
    const double mean = left / kRuns;
    const double error = std::sqrt((squares / kRuns - mean * mean) / kRuns);
    EXPECT_LE(mean, (1 - fraction) / fraction + 4 * error);
    EXPECT_GE(mean, 0.5 * (1 - fraction) / fraction) << "the limit is real";
  }
}

TEST_F(VerificationTest, NobodyChecksHimself) {
  join({1, 2});
  give(1, 0, 5);
  EXPECT_FALSE(books.next(1, kAny).has_value());
  EXPECT_TRUE(books.next(2, kAny).has_value());
}

TEST_F(VerificationTest, OnlyTheSamePixelClassChecks) {
  join({1, 2}), join({3}, "b");
  give(1, 0, 5);
  EXPECT_FALSE(books.next(3, kAny).has_value());
  EXPECT_TRUE(books.next(2, kAny).has_value());
  give(3, 0, 9, 1);
  EXPECT_EQ(books.counts().alone, 1u) << "nobody else is of its class";
}

TEST_F(VerificationTest, AThirdSettlesWhoIsWrong) {
  for (const int third : {5, 6}) {
    books = {};
    books.begin(7, 1);
    join({1, 2, 3});
    give(1, 0, 5);
    EXPECT_TRUE(check(2, 6));
    EXPECT_TRUE(wrong().empty());
    EXPECT_FALSE(check(1, 5)) << "it has said so already";
    EXPECT_TRUE(check(3, third));
    EXPECT_EQ(wrong(), std::vector<ClientId>{third == 5 ? 2u : 1u});
  }
}

TEST_F(VerificationTest, OpinionsThatAllDifferNeedAnotherOne) {
  join({1, 2, 3, 4});
  give(1, 0, 5);
  EXPECT_TRUE(check(2, 6));
  EXPECT_TRUE(check(3, 7));
  EXPECT_TRUE(check(4, 5));
  EXPECT_EQ(wrong(), (std::vector<ClientId>{2, 3}));
}

TEST_F(VerificationTest, ADisputeWithoutAThirdWaitsForOneAndHoldsNothingUp) {
  join({1, 2});
  give(1, 3, 5);
  EXPECT_TRUE(check(2, 6));
  EXPECT_EQ(books.counts().disputed, 1u);
  EXPECT_FALSE(books.firstOpen().has_value());
  EXPECT_TRUE(books.isOpen(3)) << "it may still be asked for";
  books.mark();
  EXPECT_FALSE(books.isTrusted());
  join({3});
  EXPECT_EQ(books.counts().disputed, 0u);
  EXPECT_EQ(books.firstOpen(), 3u);
  EXPECT_TRUE(check(3, 6));
  EXPECT_EQ(wrong(), std::vector<ClientId>{1});
}

TEST_F(VerificationTest, WithoutASecondClientNothingIsChecked) {
  join({1});
  give(1, 0, 5);
  EXPECT_EQ(books.counts().alone, 1u);
  EXPECT_FALSE(books.isOpen(0));
  books.mark();
  EXPECT_TRUE(books.isTrusted()) << "nobody will ever vouch for it";
  join({2});
  EXPECT_FALSE(books.next(2, kAny).has_value()) << "what was left stays left";
}

TEST_F(VerificationTest, WhoIsLostWithACheckLeavesItToOthers) {
  join({1, 2, 3});
  give(1, 0, 5);
  books.given(2, {0, 0, 0});
  EXPECT_FALSE(books.next(3, kAny).has_value());
  books.lost(2);
  EXPECT_TRUE(books.next(3, kAny).has_value());
  books.lost(3);
  EXPECT_FALSE(books.isOpen(0)) << "nobody is left who could";
}

TEST_F(VerificationTest, WhoHasLeftMayStillBeFoundWrong) {
  join({1, 2, 3});
  give(1, 0, 5);
  books.mark();
  books.lost(1);
  EXPECT_FALSE(books.isTrusted()) << "an opinion of it is open";
  EXPECT_TRUE(check(2, 6));
  EXPECT_TRUE(check(3, 6));
  EXPECT_EQ(wrong(), std::vector<ClientId>{1});
}

TEST_F(VerificationTest, ACopyThatIsUnderWayIsTheCheck) {
  join({1, 2});
  books.accepted(1, taskOf(0), digestOf(5), {2});
  EXPECT_TRUE(books.expects(2, {0, 0, 0}));
}

TEST_F(VerificationTest, WhatIsSupersededIsNotChecked) {
  join({1, 2});
  give(1, 0, 5), give(1, 4, 5);
  books.accepted(1, taskOf(1, 0, true), digestOf(5), {});
  books.drop(4, false);
  EXPECT_EQ(books.firstOpen(), 1u) << "steps are left";
  books.drop(4, true);
  EXPECT_EQ(books.firstOpen(), 4u);
}

TEST_F(VerificationTest, TooManyOpenChecksAskForAPause) {
  join({1, 2});
  for (int tile = 0; tile < static_cast<int>(Verification::kMostOpen); ++tile) {
    EXPECT_FALSE(books.isFull());
    give(1, 0, 5, tile);
  }
  EXPECT_TRUE(books.isFull());
}

// --- in the scheduler ---

class VerifyingScheduler : public testing::Test {
 protected:
  // Client 3 answers wrongly.
  Digest digest(ClientId client, const TaskId& task) const {
    const int right = static_cast<int>(task.frame * 31) + task.tile * 7 + task.phase;
    return digestOf(right + (client == wrongClient ? 1 : 0));
  }
  void verify(double fraction, int clients) {
    bench.scheduler.verify(7, fraction);
    for (int c = 1; c <= clients; ++c) bench.join(static_cast<ClientId>(c));
  }
  // All clients answer all that they are sent.
  void drain() {
    for (bool any = true; any;) {
      any = false;
      for (const ClientReport& report : bench.scheduler.report(bench.now)) {
        auto& sent = bench.sent[report.client];
        bench.pass(milliseconds(4));
        if (sent.empty() || report.lost) continue;
        const TaskId task = sent.front();
        sent.erase(sent.begin());
        ++done[{task.frame, task.tile * 100 + task.phase}];
        bench.scheduler.resultArrived(report.client, task, TaskCost{milliseconds(4)}, bench.now,
                                      digest(report.client, task));
        bench.pass(Duration(0));
        any = true;
      }
    }
  }
  SchedulerBench bench;
  ClientId wrongClient = 0;
  std::map<std::pair<uint32_t, int>, int> done;  // how often each task was
};

TEST_F(VerifyingScheduler, EachChosenTaskIsDoneTwiceAndTheFrameDoesNotWait) {
  verify(1, 3);
  bench.open(0, bench.grid(4));
  drain();
  EXPECT_EQ(bench.scheduler.counts().completedFrames, 1u);
  EXPECT_EQ(bench.scheduler.verificationCounts().checked, 36u);
  for (const auto& [task, times] : done) EXPECT_EQ(times, 2);
  EXPECT_EQ(bench.scheduler.firstUnsettled(), 1u);
}

TEST_F(VerifyingScheduler, OnlyChosenTasksAreDoneTwice) {
  verify(0.5, 3);
  bench.open(0, bench.grid(40));
  drain();
  Verification rule;
  rule.begin(7, 0.5);
  int checked = 0;
  for (int tile = 0; tile < 40; ++tile) checked += 9 * rule.isChosen({0, tile, 0});
  EXPECT_EQ(bench.scheduler.verificationCounts().checked, static_cast<uint64_t>(checked));
}

TEST_F(VerifyingScheduler, AWrongClientIsTold) {
  verify(0.2, 3);
  wrongClient = 3;
  bench.open(0, bench.grid(40));
  drain();
  ASSERT_FALSE(bench.wrong.empty());
  for (const WrongNote& note : bench.wrong) EXPECT_EQ(note.client, 3u);
}

TEST_F(VerifyingScheduler, UnitsOfStepsAreCheckedToo) {
  verify(1, 3);
  wrongClient = 2;
  bench.scheduler.openStep(0, 40, 12, 100);
  bench.pass(Duration(0));
  drain();
  EXPECT_EQ(bench.scheduler.counts().completedSteps, 1u);
  EXPECT_EQ(bench.scheduler.verificationCounts().checked, 12u);
  ASSERT_FALSE(bench.wrong.empty());
  EXPECT_TRUE(bench.wrong[0].task.isStep);
}

TEST_F(VerifyingScheduler, ASilentCheckerLosesItsChecksToOthers) {
  verify(1, 3);
  bench.open(0, bench.grid(2, {1, 1}));
  while (bench.scheduler.counts().completedFrames == 0)
    for (const ClientId client : {1u, 2u})
      if (!bench.sent[client].empty()) {
        const TaskId task = bench.sent[client].front();
        bench.sent[client].erase(bench.sent[client].begin());
        bench.scheduler.resultArrived(client, task, TaskCost{milliseconds(4)}, bench.now,
                                      digest(client, task));
        bench.pass(milliseconds(4));
      } else {
        bench.pass(milliseconds(100));
      }
  bench.sent[3].clear();  // it hangs
  for (int i = 0; i < 200; ++i)
    bench.pass(milliseconds(100)), bench.scheduler.clientHeard(1, bench.now);
  for (const ClientId client : {1u, 2u})
    while (!bench.sent[client].empty()) {
      const TaskId task = bench.sent[client].front();
      bench.sent[client].erase(bench.sent[client].begin());
      bench.scheduler.resultArrived(client, task, TaskCost{milliseconds(4)}, bench.now,
                                    digest(client, task));
      bench.pass(milliseconds(4));
    }
  EXPECT_EQ(bench.scheduler.firstUnsettled(), 1u);
}

TEST_F(VerifyingScheduler, TooManyOpenChecksHoldFramesBack) {
  verify(1, 2);
  uint32_t frame = 0;
  // Client 2 takes checks and gives nothing; client 1 is quick.
  for (; frame < 400 && bench.scheduler.wantsFrame(); ++frame) {
    bench.open(frame, bench.grid(1));
    while (!bench.sent[1].empty()) {
      const TaskId task = bench.sent[1].front();
      bench.sent[1].erase(bench.sent[1].begin());
      bench.scheduler.resultArrived(1, task, TaskCost{milliseconds(1)}, bench.now, digest(1, task));
      bench.pass(Duration(0));
    }
  }
  EXPECT_LT(frame, 400u);
}

}  // namespace
}  // namespace ninefold
