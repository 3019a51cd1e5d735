// scheduler_client.h: what the scheduler knows of one client: the tasks that it holds, its learned
// speed and its credit.
//
// Credit: how many tasks a client may hold, between two numbers,
//     low = T + ceil(T (r+w)/t)      high = low + max(ceil(T/2), ceil(T w/t))
//   T  threads      t  time of a task, a moving average of what it reports      r  round trip
//   w  how long a result waits for others (kResultsTogether; 0 while the newest frame is urgent)
// T tasks are worked on, T (r+w)/t more are on their way: so a client never pauses. It is refilled
// up to high whenever it falls to low: tasks travel in groups, as results do. A group has at most
// kMaxGroup T tasks, all together kMaxPerThread T: a frame waits for all that its slowest client
// holds.
//
// Trust. trusted --no result for silenceLimit()--> suspect --any result--> trusted;
//        suspect --heard of, and holds nothing--> trial (one task) --result--> trusted,
//        --silence--> suspect.
//
// Stuck. A client works on the T oldest tasks that it holds; the deadline of such a task is
//     begin + (r+w) + c + allowance(n)    n  rays that the task is expected to take (task_rays.h)
//                                         c  time that it took to build the scene: an edit may
//                                            ask for that again
//     allowance(n) = 10 s + 8 n (s+l)     s  longest time for a ray of late, over its results
//                                         l  the same over those that made a light set
//     allowance(n) = 30 s + n 0.1 ms      before its first result, some 300 times what rays take
// s and l fall by 1/64 with each result of their kind. A result past its deadline counts as at most
// twice what was allowed: a deadline that was too short doubles. A client past a deadline is stuck
// and suspect, until a result leaves it no task past its deadline. If all its tasks were withdrawn,
// it is tried with one task again kRetryStuck later.
// Owner: Scheduler.   Threads: none.   Errors: NINEFOLD_CHECK only.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "master/scheduling/scheduler_types.h"

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
  static constexpr Duration kAllowedAtLeast = std::chrono::seconds(10);
  static constexpr Duration kAllowedBeforeFirst = std::chrono::seconds(30);
  static constexpr double kAllowedPerRay = 1e-4;  // [s] before the first result
  static constexpr double kAllowedFactor = 8;     // times the longest time for a ray
  static constexpr Duration kRetryStuck = std::chrono::seconds(10);

  SchedulerClient(ClientId id, int threads, Time now);

  ClientId id() const { return report_.client; }
  int threads() const { return report_.threads; }
  int inFlight() const { return static_cast<int>(held_.size()); }
  const std::vector<HeldTask>& held() const { return held_; }  // oldest first
  bool holds(const TaskId& task) const;

  int low() const;
  int high() const;
  // Tasks that may be sent now; 0 once refilled, until it falls to low().
  int credit() const { return refilling_ ? std::max(0, high() - inFlight()) : 0; }
  // Units of a step that may be sent to it at once, whatever its credit: they are much shorter than
  // tasks of frames, by which credit goes.
  int unitsAtOnce() const;

  Duration taskTime() const { return taskTime_.value_or(kFirstGuess); }
  // From now until the result of one more task would be here.
  Duration timeForOneMore() const { return roundTrip_ + workTime(inFlight() + 1); }
  // How long it may hold tasks without giving any result.
  Duration silenceLimit() const;
  Time silentSince() const { return silentSince_; }
  Trust trust() const { return trust_; }

  // How long a thread of it may be at work on a task of so many rays.
  Duration allowance(double rays) const;
  // When the first of the tasks that it is at work on is past its deadline.
  std::optional<Time> deadline() const;
  // The task that it is at work on for longest, of those past their deadline.
  std::optional<HeldTask> overdue(Time now) const;
  std::optional<Time> stuckSince() const { return stuckSince_; }

  void take(const HeldTask& task, Time now);
  // Its result came, wanted or not; learns the client's speed.
  void answered(const TaskId& task, TaskCost cost, bool accepted, Time now);
  // Forgets what it holds of frames, or of steps, before firstWanted. False if that was nothing.
  bool withdraw(uint32_t firstWanted, bool steps, Time now);
  void heard(Time now) { lastHeard_ = now; }
  void becomeStuck(Time now);
  void becomeUnstuck() { stuckSince_.reset(); }
  // Whoever tells the time did not run for so long: deadlines move.
  void excuse(Duration pause);
  void measureRoundTrip(Duration roundTrip);
  void setResultsWait(Duration time);
  void setSceneTime(Duration time) { sceneTime_ = time; }
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
  void beginTasks(Time now);
  Time deadlineOf(const HeldTask& held) const;  // needs one that it is at work on
  void learn(TaskCost cost, const HeldTask* task);

  ClientReport report_;
  Time joined_;
  std::vector<HeldTask> held_;
  bool refilling_ = true;
  Trust trust_ = Trust::trusted;
  std::optional<Duration> taskTime_;
  std::optional<double> secondsPerRay_;  // s above
  double lightSecondsPerRay_ = 0;        // l above
  std::optional<Time> stuckSince_;
  Duration roundTrip_{0}, resultsWait_{0}, sceneTime_{0};
  Time silentSince_, lastHeard_;
  bool owesAnswer_ = false;  // tasks were withdrawn from it since its last result
  uint32_t randomization_ = 0;
  std::vector<int> sets_;  // made under randomization_, latest last
};

}  // namespace ninefold
