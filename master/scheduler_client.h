// scheduler_client.h: what the scheduler knows of one client: the tasks that it holds, its learned
// speed and its credit.
//
// Credit. With T threads, task time t (moving average of what it reports), round trip r, and w for
// which a result waits for others (kResultsTogether; 0 while frames are urgent), a client works
// without a pause if it holds T tasks to work on and T (r+w)/t more that are on their way:
//     low = T + ceil(T (r+w)/t)      high = low + max(ceil(T/2), ceil(T w/t))
// It is refilled up to high whenever it falls to low: two numbers, so that tasks travel in groups, as
// results do. A group has at most kMaxGroup T, all together kMaxPerThread T: a frame waits for all that
// its slowest client holds.
//
// Trust. trusted --no result for silenceLimit()--> suspect --any result--> trusted;
//        suspect --heard of, and holds nothing--> trial (one task) --result--> trusted,
//        --silence--> suspect.
// Owner: Scheduler. Threads: none. Errors: NINEFOLD_CHECK only.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "master/scheduler_types.h"

namespace ninefold {

enum class Trust : uint8_t { trusted, trial, suspect };

class SchedulerClient {
 public:
  static constexpr int kMaxPerThread = 64;  // bounds what a slow line can ask for
  static constexpr int kMaxGroup = 8;       // tasks that travel at once, for each thread
  static constexpr Duration kFirstGuess = milliseconds(100);       // task time before any result
  static constexpr Duration kSilenceAtLeast = milliseconds(1000);  // see silenceLimit()
  static constexpr Duration kSilenceBeforeFirst = milliseconds(5000);
  static constexpr int kSilenceFactor = 4;  // times the expected time for all that it holds

  SchedulerClient(ClientId id, int threads, Time now);

  ClientId id() const { return report_.client; }
  int threads() const { return report_.threads; }
  int inFlight() const { return static_cast<int>(held_.size()); }
  const std::vector<TaskId>& held() const { return held_; }
  bool holds(const TaskId& task) const { return std::ranges::find(held_, task) != held_.end(); }

  int low() const;
  int high() const;
  // Tasks that may be sent now; 0 once refilled, until it falls to low().
  int credit() const { return refilling_ ? std::max(0, high() - inFlight()) : 0; }

  Duration taskTime() const { return taskTime_.value_or(kFirstGuess); }
  // From now until the result of one more task would be here.
  Duration timeForOneMore() const { return roundTrip_ + workTime(inFlight() + 1); }
  // How long it may hold tasks without giving any result.
  Duration silenceLimit() const;
  Time silentSince() const { return silentSince_; }
  Trust trust() const { return trust_; }

  void take(const TaskId& task, Time now);
  void answered(const TaskId& task);  // its result came, wanted or not
  // Forgets what it holds of frames before firstWanted. False if that was nothing.
  bool withdraw(uint32_t firstWanted);
  void heard(Time now) { lastHeard_ = now; }
  // Learns its speed; trusts it from now on.
  void gaveResult(Duration cost, bool accepted, Time now);
  void measureRoundTrip(Duration roundTrip);
  void setResultsWait(Duration time);
  void setTrust(Trust trust, Time now);

  // Light sets that it made of late, for frames that share a randomization (while the picture
  // moves).
  void rememberSet(uint32_t randomization, int set);
  bool remembersSet(uint32_t randomization, int set) const;

  ClientReport& counts() { return report_; }
  ClientReport report(Time now) const;

 private:
  static constexpr size_t kRemembered = 4;
  // How many tasks it does in a time, rounded up; at most mostPerThread a thread.
  int tasksIn(Duration time, int mostPerThread) const;
  Duration workTime(int tasks) const { return taskTime() * ((tasks + threads() - 1) / threads()); }
  void updateRefilling();

  ClientReport report_;
  Time joined_;
  std::vector<TaskId> held_;  // sent and not answered, oldest first
  bool refilling_ = true;
  Trust trust_ = Trust::trusted;
  std::optional<Duration> taskTime_;
  Duration roundTrip_{0}, resultsWait_{0};
  Time silentSince_, lastHeard_;
  bool owesAnswer_ = false;  // tasks were withdrawn from it since its last result
  uint32_t randomization_ = 0;
  std::vector<int> sets_;  // made under randomization_, latest last
};

}  // namespace ninefold
