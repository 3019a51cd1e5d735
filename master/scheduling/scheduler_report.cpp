// scheduler_report.cpp: the scheduler seen from outside: what its clients did, why a task waits,
// and whether its books balance.
#include <fmt/core.h>

#include <algorithm>

#include "common/base/error.h"
#include "master/scheduling/scheduler.h"

namespace ninefold {
namespace {

double millisecondsBetween(Time from, Time to) { return 1000 * seconds(to - from); }

std::string describe(const TaskHolder& holder, Time now) {
  if (!holder.active)
    return fmt::format("client {} has had it for {:.0f} ms and is silent or stuck", holder.client,
                       millisecondsBetween(holder.sent, now));
  return fmt::format("in flight at client {} for {:.0f} ms{}", holder.client,
                     millisecondsBetween(holder.sent, now), holder.late <= now ? ", late" : "");
}

}  // namespace

std::vector<ClientReport> Scheduler::report(Time now) const {
  std::map<ClientId, ClientReport> all = past_;
  pool_.forEach(
      [&](const SchedulerClient& client) { all.emplace(client.id(), client.report(now)); });
  std::vector<ClientReport> list;
  for (const auto& [id, report] : all) list.push_back(report);
  return list;
}

std::string Scheduler::explain(const TaskId& task, Time now) const {
  const SchedulerFrame* frame = findFrame(task.frame);
  const std::string name =
      frame != nullptr && frame->isStep()
          ? fmt::format("unit {} of step {}", task.tile, task.frame)
          : fmt::format("tile {} phase {} of frame {}", task.tile, task.phase, task.frame);
  if (frame != nullptr) {
    const int index = frame->indexOf(task);
    return name + ": " + (index < 0 ? "no such task" : explainOpen(*frame, index, now));
  }
  switch (verdictOnClosed(task.frame)) {
    case Verdict::duplicate:
      return name + ": done, the frame is complete";
    case Verdict::stale:
      return name + ": the frame was superseded or ended long ago";
    default:
      return name + ": the frame has not been opened";
  }
}

std::string Scheduler::explainOpen(const SchedulerFrame& frame, int task, Time now) const {
  if (frame.state(task) == TaskState::done) return "done";
  std::string text;
  for (const TaskHolder& holder : frame.holders(task))
    text += (text.empty() ? "" : "; ") + describe(holder, now);
  if (frame.state(task) == TaskState::active) return text;
  if (!text.empty()) text += "; ";
  text += fmt::format("waits with {} tasks of light set {}, {} of its frame: ",
                      frame.waitingOf(frame.setOf(task)), frame.setOf(task), frame.waiting());
  if (pool_.size() == 0) return text + "there is no client";
  if (pool_.ready().empty()) return text + "no client has credit";
  return text + "to be handed out by the next poll";
}

void Scheduler::checkInvariants() const {
  pool_.checkInvariants();
  size_t claims = 0;
  for (const auto& [number, frame] : frames_) {
    frame.checkInvariants();
    NINEFOLD_CHECK(number < nextFrame_);
    for (int task = 0; task < frame.tasks(); ++task)
      for (const TaskHolder& holder : frame.holders(task)) {
        const SchedulerClient* client = pool_.find(holder.client);
        NINEFOLD_CHECK(client != nullptr);
        NINEFOLD_CHECK(client->holds(frame.idOf(task)));
        NINEFOLD_CHECK(holder.active == (client->trust() != Trust::suspect));
        ++claims;
      }
  }
  // What a client holds is a claim above, or a copy of a task that another client has finished.
  size_t held = 0;
  pool_.forEach([&](const SchedulerClient& client) {
    for (const HeldTask& task : client.held()) held += isUnfinished(task.task);
  });
  NINEFOLD_CHECK(claims == held);
  for (const auto& [id, task] : verification_.holders()) {
    const SchedulerClient* client = pool_.find(id);
    NINEFOLD_CHECK(client != nullptr);
    NINEFOLD_CHECK(client->holds(task));
    NINEFOLD_CHECK(client->trust() != Trust::suspect);
  }
}

bool Scheduler::isUnfinished(const TaskId& task) const {
  const SchedulerFrame* frame = findFrame(task.frame);
  return frame != nullptr && frame->state(frame->indexOf(task)) != TaskState::done;
}

}  // namespace ninefold
