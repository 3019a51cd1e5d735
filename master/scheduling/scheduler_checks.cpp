// scheduler_checks.cpp: results that a second client does again (verification.h).
#include <algorithm>

#include "master/scheduling/scheduler.h"

namespace ninefold {

uint32_t Scheduler::firstUnsettled() const {
  const uint32_t open = frames_.empty() ? nextFrame_ : frames_.begin()->first;
  return std::min(open, verification_.firstOpen().value_or(open));
}

// For what is to be compared: others that hold the task, too, may check it.
void Scheduler::noteResult(ClientId id, const TaskId& task, const std::optional<Digest>& digest) {
  if (!verification_.isOn()) return;
  const SchedulerFrame& frame = *findFrame(task.frame);
  const int index = frame.indexOf(task);
  std::vector<ClientId> copies;
  for (const TaskHolder& holder : frame.holders(index))
    if (holder.active && holder.client != id) copies.push_back(holder.client);
  verification_.accepted(id, frame.heldTask(index), digest, copies);
}

void Scheduler::handOutChecks(Actions& actions, Time now) {
  if (!verification_.isOn()) return;
  std::vector<ClientId> ready;
  for (const auto& [time, client] : pool_.ready()) ready.push_back(client);
  for (const ClientId id : ready) {
    SchedulerClient& client = *pool_.find(id);
    // What it was given before it was doubted it may still hold.
    const auto mayHold = [&](const TaskId& task) { return !client.holds(task); };
    while (client.credit() > 0) {
      const std::optional<HeldTask> task = verification_.next(id, mayHold);
      if (!task) break;
      verification_.given(id, task->task);
      send(client, *task, actions, now);
    }
  }
}

}  // namespace ninefold
