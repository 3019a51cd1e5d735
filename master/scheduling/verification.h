// verification.h: results that are done again by a second client of the same pixel class, and what
// follows if the two differ. Pure.
//
//   chosen       a pure function of (seed, frame, tile): hash / 2^64 < P; of a step: (step, unit)
//   opinion      what a client gave for a chosen task: the digest of its content
//   agreement    two clients gave the same. Who gave something else is wrong.
//   dispute      all opinions so far differ: one more client is asked, until two agree
//
// Every result of a client has a place in the order in which results came. An agreement vouches for
// all of its kind (tasks of frames, units of steps) that the client gave up to then: who errs in
// units may be right in all tasks. A *mark* is a moment that somebody wants to come back to: it is
// trusted once all clients have agreements later than what they gave before it, and no older
// opinion is open.
// Nobody vouches for a client that is alone in its class, or has left: it counts as trusted as soon
// as none of its opinions is open.
//
// A task is not checked if nobody else is there who could. A dispute waits for one more client; as
// long as there is none it holds nothing up.
//
// Bounded: isFull() says when no more frames should be opened. Cost: O(open checks) for a question.
// Owner: Scheduler.   Threads: none.   Errors: NINEFOLD_CHECK only.
// Proved: tests/master/verification_test.cpp, tests/cluster/verify_test.py.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "master/scheduling/scheduler_types.h"

namespace ninefold {

class Verification {
 public:
  static constexpr size_t kMostOpen = 1024;    // without disputes
  static constexpr size_t kMostDisputes = 16;  // that wait for one more client

  // fraction: P; 0: nothing is checked.
  void begin(uint64_t seed, double fraction) { seed_ = seed, fraction_ = fraction; }
  bool isOn() const { return fraction_ > 0; }
  bool isChosen(const TaskId& task) const;

  void joined(ClientId client, const std::string& pixelClass);
  void lost(ClientId client);
  // It may not give the results that it holds.
  void release(ClientId client);

  // The first result of a task came. `copies`: others that hold the task, too.
  void accepted(ClientId client, const HeldTask& task, const std::optional<Digest>& digest,
                const std::vector<ClientId>& copies);
  // The client was given the task to check another's result.
  bool expects(ClientId client, const TaskId& task) const;
  void answered(ClientId client, const TaskId& task, const Digest& digest);

  // A task that this client may check, of those that `mayHold` allows.
  std::optional<HeldTask> next(ClientId client,
                               const std::function<bool(const TaskId&)>& mayHold) const;
  void given(ClientId client, const TaskId& task);

  // Nothing of frames, or of steps, before `firstWanted` is to be checked any more.
  void drop(uint32_t firstWanted, bool steps);

  bool isFull() const { return checks_.size() >= kMostOpen; }
  bool isOpen(uint32_t frame) const;          // something of it is to be checked
  std::optional<uint32_t> firstOpen() const;  // the least such frame, disputes apart

  void mark();
  void unmark() { mark_.reset(); }
  bool isTrusted() const;  // the mark is, and there is one

  // Since the last time, in order.
  std::vector<WrongNote> takeWrong() { return std::exchange(wrong_, {}); }
  const VerificationCounts& counts() const { return counts_; }
  // Who holds which task to check it.
  std::vector<std::pair<ClientId, TaskId>> holders() const;

 private:
  struct Opinion {
    ClientId client = 0;
    Digest digest{};
    uint64_t order = 0;  // of the result among all
  };
  struct Check {
    HeldTask task;
    std::vector<Opinion> opinions;  // all differ
    std::optional<ClientId> holder = std::nullopt;
    bool isDispute() const { return opinions.size() > 1; }
  };
  using Orders = std::array<uint64_t, 2>;  // of results among all: of a task's, of a unit's
  struct Giver {
    std::string pixelClass;
    bool present = true;
    Orders latest{}, agreed{};  // of its latest results; of the latest that agreed
  };
  using Checks = std::map<TaskId, Check>;

  bool hasOpinion(const Check& check, ClientId client) const;
  bool mayCheck(ClientId client, const Check& check) const;
  bool canGoOn(const Check& check) const;
  void judge(Checks::iterator check);
  void review();

  uint64_t seed_ = 0, order_ = 0;
  double fraction_ = 0;
  Checks checks_, disputes_;  // disputes_: that wait for one more client
  std::map<ClientId, Giver> givers_;
  struct Mark {
    uint64_t order = 0;
    std::map<ClientId, Orders> latest;
  };
  std::optional<Mark> mark_;
  std::vector<WrongNote> wrong_;
  VerificationCounts counts_;
};

}  // namespace ninefold
