#include "master/serving/started_clients.h"

#include <algorithm>

#include "common/base/error.h"
#include "common/base/log.h"
#include "proto/messages.h"

namespace ninefold {
namespace {

constexpr Duration kLongLife = std::chrono::seconds(30);
constexpr Duration kFirstPause = milliseconds(100);
constexpr int kCrashesInARow = 5;
constexpr Duration kFirstPauseOfHosts = std::chrono::seconds(1);
constexpr int kMostDoublings = 6;  // about a minute
constexpr int kHangsInARow = 3;
constexpr Duration kStart = std::chrono::seconds(5);
constexpr Duration kTimeToGo = milliseconds(600);

}  // namespace

std::optional<Time> RestartPolicy::crashed(Time started, Time now) {
  if (now - started >= kLongLife) crashes_ = 0;
  ++crashes_;
  if (forEver_) return now + kFirstPauseOfHosts * (1 << std::min(crashes_ - 1, kMostDoublings));
  if (crashes_ >= kCrashesInARow) return std::nullopt;
  return now + kFirstPause * (1 << (crashes_ - 1));
}

// A hang has taken a minute and more: no other pause is needed.
std::optional<Time> RestartPolicy::hung(bool gaveResults, Time now) {
  if (gaveResults) hangs_ = 0;
  if (++hangs_ >= kHangsInARow) return std::nullopt;
  return now + kFirstPause;
}

void StartedClients::start(Time now) {
  for (const Client& client : plan_.clients) {
    slots_.push_back({client, RestartPolicy(plan_.forEver)});
    startOne(slots_.back(), now);
  }
}

void StartedClients::startOne(Slot& slot, Time now) {
  const Descriptor key(keyPipe(*plan_.key));
  std::vector<std::string> arguments = plan_.arguments;
  const auto& more = slot.client.arguments;
  arguments.insert(arguments.end(), more.begin(), more.end());
  slot.process = ChildProcess::start(plan_.program, arguments, key, plan_.child);
  slot.started = now;
  slot.startAt.reset();
}

void StartedClients::poll(Time now) {
  for (Slot& slot : slots_) {
    if (slot.process) {
      if (const auto how = slot.process->ended())
        how->status == kHungStatus ? hung(slot, now) : ended(slot, how->text, now);
      else if (killAt_ && now >= *killAt_)
        slot.process.reset();
    } else if (slot.startAt && now >= *slot.startAt) {
      restart(slot, now);
    }
  }
}

void StartedClients::restart(Slot& slot, Time now) {
  try {
    startOne(slot, now);
  } catch (const Error& error) {
    ended(slot, error.what(), now);
  }
}

void StartedClients::ended(Slot& slot, const std::string& how, Time now) {
  slot.process.reset();
  if (killAt_) return;
  ++crashes_;
  slot.startAt = slot.policy.crashed(slot.started, now);
  if (slot.startAt)
    warn("{} ended with {}; starting it again in {:.1f} s", slot.client.title, how,
         seconds(*slot.startAt - now));
  else
    warn("{} ended with {} once more and is given up", slot.client.title, how);
}

void StartedClients::hung(Slot& slot, Time now) {
  slot.process.reset();
  if (killAt_) return;
  ++crashes_;
  const Work work = workOf_ ? workOf_(slot.client.name) : Work{};
  slot.startAt = slot.policy.hung(work.results > 0, now);
  if (slot.startAt)
    return warn("{} hung in {} and ended itself; starting it again", slot.client.title,
                work.oldestTask);
  hang_ = fmt::format(
      "{} hung {} times in a row without a result, at last in {}, and is given up; "
      "its own lines above say how to see that again",
      slot.client.title, kHangsInARow, work.oldestTask);
  warn("{}", *hang_);
}

bool StartedClients::isStarting(Time now) const {
  for (const Slot& slot : slots_)
    if (slot.startAt || (slot.process && now - slot.started < kStart)) return true;
  return false;
}

void StartedClients::stop(Time now) {
  killAt_ = now + kTimeToGo;
  for (Slot& slot : slots_) {
    slot.startAt.reset();
    if (slot.process) slot.process->terminate();
  }
}

int StartedClients::running() const {
  int count = 0;
  for (const Slot& slot : slots_) count += slot.process ? 1 : 0;
  return count;
}

bool StartedClients::exhausted() const {
  for (const Slot& slot : slots_)
    if (slot.process || slot.startAt) return false;
  return !slots_.empty();
}

}  // namespace ninefold
