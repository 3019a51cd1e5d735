#include "master/scheduling/scheduler_pool.h"

#include "common/base/error.h"

namespace ninefold {

void SchedulerPool::add(ClientId client, int threads, Time now) {
  const auto [member, added] =
      members_.emplace(client, Member{.client = SchedulerClient(client, threads, now)});
  NINEFOLD_CHECK(added);
  member->second.client.setResultsWait(resultsWait_);
  update(member->second.client);
}

void SchedulerPool::setResultsWait(Duration time) {
  if (std::exchange(resultsWait_, time) == time) return;
  change([time](SchedulerClient& client) { return client.setResultsWait(time), true; });
}

void SchedulerPool::remove(ClientId client) {
  const auto found = members_.find(client);
  NINEFOLD_CHECK(found != members_.end());
  leaveOrders(found->second);
  members_.erase(found);
}

SchedulerClient* SchedulerPool::find(ClientId client) {
  const auto found = members_.find(client);
  return found == members_.end() ? nullptr : &found->second.client;
}

const SchedulerClient* SchedulerPool::find(ClientId client) const {
  const auto found = members_.find(client);
  return found == members_.end() ? nullptr : &found->second.client;
}

void SchedulerPool::leaveOrders(Member& member) {
  if (member.credit > 0) ready_.erase({member.readyOrder, member.client.id()});
  freeCredit_ -= member.credit;
  if (member.silenceEnd) silence_.erase({*member.silenceEnd, member.client.id()});
  if (member.deadline) deadlines_.erase({*member.deadline, member.client.id()});
}

void SchedulerPool::update(SchedulerClient& client) {
  Member& member = members_.at(client.id());
  leaveOrders(member);
  member.credit = client.credit();
  member.readyOrder = client.timeForOneMore();
  member.silenceEnd.reset();
  if (client.inFlight() > 0 && client.trust() != Trust::suspect)
    member.silenceEnd = client.silentSince() + client.silenceLimit();
  member.deadline = client.stuckSince() ? std::nullopt : client.deadline();
  if (member.credit > 0) ready_.insert({member.readyOrder, client.id()});
  freeCredit_ += member.credit;
  if (member.silenceEnd) silence_.insert({*member.silenceEnd, client.id()});
  if (member.deadline) deadlines_.insert({*member.deadline, client.id()});
}

std::optional<ClientId> SchedulerPool::firstBy(const Times& times, Time now) {
  if (times.empty() || times.begin()->first > now) return std::nullopt;
  return times.begin()->second;
}

std::optional<ClientId> SchedulerPool::silent(Time now) const { return firstBy(silence_, now); }

std::optional<ClientId> SchedulerPool::overdue(Time now) const { return firstBy(deadlines_, now); }

void SchedulerPool::checkInvariants() const {
  int credit = 0;
  size_t ready = 0, watched = 0, timed = 0;
  for (const auto& [id, member] : members_) {
    const SchedulerClient& client = member.client;
    const int bound = SchedulerClient::kMaxPerThread * client.threads();
    NINEFOLD_CHECK(member.credit == client.credit());
    NINEFOLD_CHECK(client.inFlight() <= bound);
    NINEFOLD_CHECK(client.low() <= client.high());
    NINEFOLD_CHECK(client.high() <= bound);
    credit += member.credit;
    ready += member.credit > 0;
    watched += member.silenceEnd.has_value();
    NINEFOLD_CHECK((client.inFlight() > 0 && client.trust() != Trust::suspect) ==
                   member.silenceEnd.has_value());
    timed += member.deadline.has_value();
    NINEFOLD_CHECK((client.inFlight() > 0 && !client.stuckSince()) == member.deadline.has_value());
    NINEFOLD_CHECK(!client.stuckSince() || client.trust() != Trust::trusted);
    NINEFOLD_CHECK(!member.deadline || member.deadline == client.deadline());
  }
  NINEFOLD_CHECK(credit == freeCredit_);
  NINEFOLD_CHECK(ready == ready_.size());
  NINEFOLD_CHECK(watched == silence_.size());
  NINEFOLD_CHECK(timed == deadlines_.size());
}

}  // namespace ninefold
