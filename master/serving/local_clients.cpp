#include "master/serving/local_clients.h"

#include "common/base/error.h"
#include "common/base/log.h"
#include "proto/messages.h"

namespace ninefold {
namespace {

constexpr Duration kLongLife = std::chrono::seconds(30);
constexpr Duration kFirstPause = milliseconds(100);
constexpr int kCrashesInARow = 5;
constexpr int kHangsInARow = 3;
constexpr Duration kStart = std::chrono::seconds(5);
constexpr Duration kTimeToGo = milliseconds(600);

}  // namespace

std::optional<Time> RestartPolicy::crashed(Time started, Time now) {
  if (now - started >= kLongLife) crashes_ = 0;
  if (++crashes_ >= kCrashesInARow) return std::nullopt;
  return now + kFirstPause * (1 << (crashes_ - 1));
}

// A hang has taken a minute and more: no other pause is needed.
std::optional<Time> RestartPolicy::hung(bool gaveResults, Time now) {
  if (gaveResults) hangs_ = 0;
  if (++hangs_ >= kHangsInARow) return std::nullopt;
  return now + kFirstPause;
}

void LocalClients::start(Time now) {
  for (int i = 0; i < plan_.count; ++i) {
    slots_.emplace_back().number = i + 1;
    startOne(slots_.back(), now);
  }
}

void LocalClients::startOne(Slot& slot, Time now) {
  const Descriptor key(keyPipe(*plan_.key));
  std::vector<std::string> arguments = plan_.arguments;
  arguments.push_back("--name=" + slot.name());
  arguments.push_back(fmt::format("--key-descriptor={}", kInheritedDescriptor));
  slot.process = ChildProcess::start(plan_.program, arguments, key);
  slot.started = now;
  slot.startAt.reset();
}

void LocalClients::poll(Time now) {
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

void LocalClients::restart(Slot& slot, Time now) {
  try {
    startOne(slot, now);
  } catch (const Error& error) {
    ended(slot, error.what(), now);
  }
}

void LocalClients::ended(Slot& slot, const std::string& how, Time now) {
  slot.process.reset();
  if (killAt_) return;
  ++crashes_;
  slot.startAt = slot.policy.crashed(slot.started, now);
  if (slot.startAt)
    warn("local client {} ended with {}; starting it again in {:.1f} s", slot.number, how,
         seconds(*slot.startAt - now));
  else
    warn("local client {} ended with {} once more and is given up", slot.number, how);
}

void LocalClients::hung(Slot& slot, Time now) {
  slot.process.reset();
  if (killAt_) return;
  ++crashes_;
  const Work work = workOf_ ? workOf_(slot.name()) : Work{};
  slot.startAt = slot.policy.hung(work.results > 0, now);
  if (slot.startAt)
    return warn("local client {} hung in {} and ended itself; starting it again", slot.number,
                work.oldestTask);
  hang_ = fmt::format(
      "local client {} hung {} times in a row without a result, at last in {}, and is given up; "
      "its own lines above say how to see that again",
      slot.number, kHangsInARow, work.oldestTask);
  warn("{}", *hang_);
}

bool LocalClients::isStarting(Time now) const {
  for (const Slot& slot : slots_)
    if (slot.startAt || (slot.process && now - slot.started < kStart)) return true;
  return false;
}

void LocalClients::stop(Time now) {
  killAt_ = now + kTimeToGo;
  for (Slot& slot : slots_) {
    slot.startAt.reset();
    if (slot.process) slot.process->terminate();
  }
}

int LocalClients::running() const {
  int count = 0;
  for (const Slot& slot : slots_) count += slot.process ? 1 : 0;
  return count;
}

bool LocalClients::exhausted() const {
  for (const Slot& slot : slots_)
    if (slot.process || slot.startAt) return false;
  return plan_.count > 0;
}

}  // namespace ninefold
