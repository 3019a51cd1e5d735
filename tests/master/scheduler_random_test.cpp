// Ten thousand random events, the books checked after each: the cheapest insurance there is.
#include <random>

#include "tests/master/scheduler_bench.h"
#include "tests/seeds.h"

namespace ninefold {
namespace {

class RandomLife {
 public:
  explicit RandomLife(uint32_t seed) : random_(seed) {}

  void play(int events) {
    for (int i = 0; i < events; ++i) {
      step();
      if (::testing::Test::HasFailure()) return;
    }
    // In the end all frames complete as soon as one client works.
    join();
    frozen_.clear(), stuck_.clear();
    for (int round = 0; round < 100 && bench_.scheduler.openFrames() > 0; ++round) {
      bench_.drain();
      bench_.pass(milliseconds(100));
    }
    EXPECT_EQ(bench_.scheduler.openFrames(), 0);
    const SchedulerCounts& n = bench_.scheduler.counts();
    EXPECT_EQ(n.accepted + n.cancelledTasks, tasks_);
    EXPECT_EQ(n.completedFrames + n.cancelledFrames, nextFrame_);
    EXPECT_GT(n.reissued, 0u);
    EXPECT_GT(n.duplicated, 0u);
    EXPECT_GT(n.droppedDuplicate, 0u);
    EXPECT_GT(n.droppedStale, 0u);
    EXPECT_GT(n.droppedUnknown, 0u);
    EXPECT_GT(n.clientsStuck, 0u);
    EXPECT_GT(std::ranges::count_if(bench_.notes, &StuckNote::isBack), 0);
  }

 private:
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }
  void join() {
    present_.push_back(nextClient_);
    bench_.join(nextClient_++, 1 + below(4));
  }
  ClientId anyone() {
    return present_[static_cast<size_t>(below(static_cast<int>(present_.size())))];
  }

  void step() {
    const int dice = below(1000);
    if (present_.empty() || (dice < 15 && present_.size() < 12)) return join();
    const ClientId c = anyone();
    if (dice < 25)
      return std::erase(present_, c), frozen_.erase(c), stuck_.erase(c), bench_.lose(c);
    if (dice < 33) return frozen_.insert(c), void();
    if (dice < 40) return stuck_.insert(c), void();
    if (dice < 60) return frozen_.erase(c), stuck_.erase(c), void();
    if (dice < 70) return bench_.viewChanged(nextFrame_ - static_cast<uint32_t>(below(2)));
    if (dice < 90) return strange(c);
    if (dice < 100) return bench_.scheduler.roundTripMeasured(c, milliseconds(below(50)));
    if (dice < 105) return bench_.pass(milliseconds(below(below(5) == 0 ? 60000 : 8000)));
    if (dice < 107) return bench_.pause(milliseconds(below(100000)));
    if (dice < 150 || (bench_.scheduler.wantsFrame() && bench_.scheduler.openFrames() < 2))
      return open();
    bench_.pass(std::chrono::microseconds(below(4000)));
    if (frozen_.contains(c)) return;
    bench_.scheduler.clientHeard(c, bench_.now);
    if (stuck_.contains(c)) return answerWithAnotherThread(c);
    if (!bench_.sent[c].empty()) answerOne(c);
  }
  void open() {
    if (bench_.scheduler.openFrames() >= 4) return;
    const TileGrid grid(1 + below(400), 1 + below(200), {1 + below(3), 1 + below(3)});
    bench_.open(nextFrame_, grid, static_cast<uint32_t>(below(2)), {below(2) == 0, below(2) == 0});
    tasks_ += static_cast<uint64_t>(bench_.scheduler.tasksLeft(nextFrame_++));
  }
  // Only its oldest task does not end, if it has threads for others.
  void answerWithAnotherThread(ClientId c) {
    const auto& tasks = bench_.sent[c];
    if (tasks.size() > 1 && below(2) == 0) answer(c, tasks.back());
  }
  void answerOne(ClientId c) {
    const auto& tasks = bench_.sent[c];
    answer(c, tasks[static_cast<size_t>(below(static_cast<int>(tasks.size())))]);
  }
  void answer(ClientId c, TaskId task) {
    const Verdict expected = bench_.scheduler.verdictOn(c, task);
    const bool wasOpen = bench_.scheduler.isOpen(task.frame);
    EXPECT_EQ(bench_.answer(c, task, milliseconds(1 + below(20))), expected);
    EXPECT_NE(expected, Verdict::unknown) << bench_.scheduler.explain(task, bench_.now);
    EXPECT_EQ(isAccepted(expected) && !wasOpen, false);
    last_ = task;
  }
  // Results that were never asked for, or are told twice.
  void strange(ClientId c) {
    const TaskId made{.frame = static_cast<uint32_t>(below(static_cast<int>(nextFrame_) + 2)),
                      .tile = below(40) - 2,
                      .phase = below(12) - 1};
    for (const TaskId& task : {made, last_}) {
      const uint64_t accepted = bench_.scheduler.counts().accepted;
      const auto& sent = bench_.sent[c];
      if (std::ranges::count(sent, task) > 0) continue;  // it was asked for: that is answerOne's
      bench_.answer(c, task);
      EXPECT_EQ(bench_.scheduler.counts().accepted, accepted);
    }
  }

  std::mt19937 random_;
  SchedulerBench bench_;
  std::vector<ClientId> present_;
  std::set<ClientId> frozen_;  // do nothing
  std::set<ClientId> stuck_;   // are heard of, and do not get on
  ClientId nextClient_ = 1;
  uint32_t nextFrame_ = 0;
  uint64_t tasks_ = 0;
  TaskId last_;
};

TEST(SchedulerRandom, TheBooksBalanceWhateverHappens) {
  for (const uint64_t seed : seedsFrom(1, 3)) {
    const Repeatable repeatable(seed);
    RandomLife(static_cast<uint32_t>(seed)).play(10'000);
  }
}

}  // namespace
}  // namespace ninefold
