// scheduler_explain.cpp: what is under way, in words: for whoever asks a running master what it
// waits for.
#include <fmt/core.h>

#include "master/scheduling/scheduler.h"

namespace ninefold {
namespace {

double millisecondsBetween(Time from, Time to) { return 1000 * seconds(to - from); }

// The task that a client has had for longest; without one, the first that waits.
int longestUnderWay(const SchedulerFrame& frame) {
  int longest = -1, waits = -1;
  std::optional<Time> since;
  for (int task = 0; task < frame.tasks(); ++task) {
    if (frame.state(task) == TaskState::waiting && waits < 0) waits = task;
    if (frame.state(task) != TaskState::active) continue;
    for (const TaskHolder& holder : frame.holders(task))
      if (holder.active && (!since || holder.sent < *since)) longest = task, since = holder.sent;
  }
  return longest >= 0 ? longest : waits;
}

int countTasks(const SchedulerFrame& frame, TaskState state) {
  int count = 0;
  for (int task = 0; task < frame.tasks(); ++task) count += frame.state(task) == state ? 1 : 0;
  return count;
}

std::string trustOf(const SchedulerClient& client, Time now) {
  if (const auto since = client.stuckSince())
    return fmt::format(", stuck for {:.0f} s: gets nothing before it gives a result",
                       seconds(now - *since));
  if (client.trust() == Trust::suspect) return ", silent: others do its tasks, too";
  if (client.trust() == Trust::trial) return ", on trial with one task";
  return {};
}

std::string workOf(const SchedulerClient& client, Time now) {
  const HeldTask& oldest = client.held().front();
  std::string text = "; the oldest is " + nameOf(oldest);
  if (oldest.begun)
    text += fmt::format(", at work on it for {:.0f} ms", millisecondsBetween(*oldest.begun, now));
  if (const auto deadline = client.deadline())
    text += fmt::format(", until it is stuck {:.1f} s", std::max(0.0, seconds(*deadline - now)));
  return text;
}

}  // namespace

std::vector<std::string> Scheduler::explainFrames(Time now) const {
  std::vector<std::string> lines;
  for (const auto& [number, frame] : frames_) {
    const int done = countTasks(frame, TaskState::done);
    lines.push_back(fmt::format("{} {}: {} of {} tasks are done, {} are at clients, {} wait",
                                frame.isStep() ? "step" : "frame", number, done,
                                done + frame.left(), frame.left() - frame.waiting(),
                                frame.waiting()));
    const int task = longestUnderWay(frame);
    if (task >= 0) lines.push_back(explain(frame.idOf(task), now));
  }
  return lines;
}

std::string Scheduler::explainClient(ClientId id, Time now) const {
  const SchedulerClient* client = pool_.find(id);
  if (client == nullptr) return "gets no tasks";
  std::string text =
      fmt::format("holds {} tasks, refilled at {} up to {}, {:.1f} ms each", client->inFlight(),
                  client->low(), client->high(), 1000 * seconds(client->taskTime()));
  text += trustOf(*client, now);
  if (client->inFlight() > 0) return text + workOf(*client, now);
  return text + (waiting() > 0 ? "; waits for the next poll" : "; waits: no task is to be had");
}

}  // namespace ninefold
