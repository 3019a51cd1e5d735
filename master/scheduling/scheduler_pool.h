// scheduler_pool.h: the clients that are present, in the four orders that the scheduler asks for:
// by id, by who would finish one more task first, by whose silence ends first, by whose deadline
// comes first.
//
// Whoever changes a client calls update() for it before the next question.
// Owner: Scheduler.   Threads: none.   Errors: NINEFOLD_CHECK only.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <utility>

#include "master/scheduling/scheduler_client.h"

namespace ninefold {

class SchedulerPool {
 public:
  using Ready = std::set<std::pair<Duration, ClientId>>;

  void add(ClientId client, int threads, Time now);
  void remove(ClientId client);
  SchedulerClient* find(ClientId client);
  const SchedulerClient* find(ClientId client) const;
  void update(SchedulerClient& client);
  // How long results may wait for others from now on, all clients'.
  void setResultsWait(Duration time);
  // Visits all clients in the order of their ids; `visit` says whether it changed the client.
  template <typename Visit>
  void change(Visit visit) {
    for (auto& [id, member] : members_)
      if (visit(member.client)) update(member.client);
  }

  int size() const { return static_cast<int>(members_.size()); }
  // Clients with credit, by the time in which they would finish one more task.
  const Ready& ready() const { return ready_; }
  int freeCredit() const { return freeCredit_; }  // summed over ready()
  // A client that holds tasks and has been silent for too long.
  std::optional<ClientId> silent(Time now) const;
  // A client that has a task past its deadline, and is not stuck yet.
  std::optional<ClientId> overdue(Time now) const;

  template <typename Visit>
  void forEach(Visit visit) const {
    for (const auto& [id, member] : members_) visit(member.client);
  }
  void checkInvariants() const;

 private:
  struct Member {
    SchedulerClient client;
    int credit = 0;  // as counted in freeCredit_; in ready_ if > 0
    Duration readyOrder{0};
    std::optional<Time> silenceEnd = std::nullopt, deadline = std::nullopt;
  };
  using Times = std::set<std::pair<Time, ClientId>>;
  static std::optional<ClientId> firstBy(const Times& times, Time now);
  void leaveOrders(Member& member);

  std::map<ClientId, Member> members_;
  Duration resultsWait_{0};
  Ready ready_;
  int freeCredit_ = 0;
  Times silence_, deadlines_;
};

}  // namespace ninefold
