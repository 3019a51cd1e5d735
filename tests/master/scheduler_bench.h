// scheduler_bench.h: a Scheduler on a test bench: keeps the time, the frames and what each client
// was sent, and checks the books after every step.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <vector>

#include "master/scheduling/scheduler.h"

namespace ninefold {

class SchedulerBench {
 public:
  Scheduler scheduler;
  Time now{};
  std::map<ClientId, std::vector<TaskId>> sent;  // and not answered
  std::vector<StuckNote> notes;                  // all so far
  std::vector<WrongNote> wrong;                  // likewise

  // A picture of `tiles` tiles with n x m phases each: tiles * n * m tasks.
  static TileGrid grid(int tiles, Interleave interleave = {3, 3}) {
    return TileGrid(kTaskSide * interleave.n * tiles, kTaskSide * interleave.m, interleave);
  }

  void join(ClientId client, int threads = 1) {
    scheduler.clientJoined(client, threads, now), act();
  }
  void lose(ClientId client) { scheduler.clientLost(client, now), sent.erase(client), act(); }
  void open(uint32_t frame, const TileGrid& grid, uint32_t randomization = 0, FrameKind kind = {}) {
    scheduler.openFrame({.frame = frame, .randomization = randomization}, grid, kind), act();
  }
  void viewChanged(uint32_t firstWanted) { scheduler.viewChanged(firstWanted, now), act(); }
  void pass(Duration time) { now += time, act(); }
  void pause(Duration time) { now += time, scheduler.paused(time), act(); }

  // The client gives the result of the first task that it was sent, or of `task`.
  Verdict answer(ClientId client, Duration cost = milliseconds(4)) {
    return answer(client, sent[client].at(0), cost);
  }
  Verdict answer(ClientId client, TaskId task, Duration cost = milliseconds(4)) {
    std::erase(sent[client], task);
    const Verdict verdict = scheduler.resultArrived(client, task, cost, now);
    act();
    return verdict;
  }

  // All clients but `silent` answer whatever they are sent until nobody has anything left.
  void drain(std::set<ClientId> silent = {}) {
    for (bool any = true; any;) {
      any = false;
      for (const ClientReport& report : scheduler.report(now)) {
        if (silent.contains(report.client) || sent[report.client].empty()) continue;
        pass(milliseconds(4));
        if (sent[report.client].empty()) continue;
        answer(report.client);
        any = true;
      }
    }
  }
  // Clients 1, 2, ... join and do a task each (frame 0), so that their speeds are known.
  void joinKnown(std::vector<Duration> costs) {
    const int count = static_cast<int>(costs.size());
    for (int c = 1; c <= count; ++c) join(static_cast<ClientId>(c));
    open(0, grid(count, {1, 1}));
    for (int c = 1; c <= count; ++c)
      while (!sent[static_cast<ClientId>(c)].empty())
        answer(static_cast<ClientId>(c), costs[static_cast<size_t>(c - 1)]);
  }

  int sentOf(uint32_t frame) const {
    int count = 0;
    for (const auto& [client, tasks] : sent)
      count += static_cast<int>(std::ranges::count(tasks, frame, &TaskId::frame));
    return count;
  }

 private:
  void act() {
    const Actions actions = scheduler.poll(now);
    for (const Cancellation& c : actions.cancel)
      std::erase_if(sent[c.client], [&](const TaskId& t) { return t.frame < c.firstWanted; });
    for (const Assignment& a : actions.assign) sent[a.client].push_back(a.task);
    notes.insert(notes.end(), actions.notes.begin(), actions.notes.end());
    wrong.insert(wrong.end(), actions.wrong.begin(), actions.wrong.end());
    scheduler.checkInvariants();
  }
};

}  // namespace ninefold
