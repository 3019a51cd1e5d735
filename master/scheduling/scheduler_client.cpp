#include "master/scheduling/scheduler_client.h"

#include "common/base/error.h"

namespace ninefold {
namespace {

constexpr double kLearn = 1.0 / 8;  // weight of the newest measurement
constexpr int kOutlier = 4;         // a measurement counts as at most this many times the average
constexpr Duration kShortestTask = std::chrono::microseconds(10);
constexpr Duration kLongestTask = std::chrono::hours(1);
constexpr Duration kLongestRoundTrip = std::chrono::seconds(10);
constexpr double kForget = 1.0 / 64;       // of the longest time for a ray, with each result
constexpr double kLateCounts = 2;          // times what was allowed, at most
constexpr double kLongestAllowance = 3e6;  // [s]

Duration average(std::optional<Duration> old, Duration sample) {
  return old ? *old + duration_cast<Duration>((sample - *old) * kLearn) : sample;
}

}  // namespace

SchedulerClient::SchedulerClient(ClientId id, int threads, Time now)
    : joined_(now), silentSince_(now), lastHeard_(now) {
  report_.client = id;
  report_.threads = std::max(1, threads);
}

int SchedulerClient::low() const {
  if (trust_ != Trust::trusted) return trust_ == Trust::trial ? 1 : 0;
  return threads() + tasksIn(roundTrip_ + resultsWait_, kMaxPerThread - kMaxGroup - 1);
}

int SchedulerClient::high() const {
  if (trust_ != Trust::trusted) return low();
  return low() + std::max((threads() + 1) / 2, tasksIn(resultsWait_, kMaxGroup));
}

int SchedulerClient::unitsAtOnce() const {
  if (trust_ != Trust::trusted) return 1;
  return std::clamp(kMaxPerThread * threads() - inFlight(), 1, kMaxGroup * threads());
}

int SchedulerClient::tasksIn(Duration time, int mostPerThread) const {
  const auto tasks = (threads() * time + taskTime() - Duration(1)) / taskTime();
  return static_cast<int>(std::min(tasks, int64_t{mostPerThread} * threads()));
}

Duration SchedulerClient::silenceLimit() const {
  const Duration expected = kSilenceFactor * (roundTrip_ + workTime(inFlight()));
  return std::max(expected, taskTime_ ? kSilenceAtLeast : kSilenceBeforeFirst);
}

void SchedulerClient::updateRefilling() {
  if (inFlight() <= low()) refilling_ = true;
  if (inFlight() >= high()) refilling_ = false;
}

bool SchedulerClient::holds(const TaskId& task) const {
  return std::ranges::find(held_, task, &HeldTask::task) != held_.end();
}

Duration SchedulerClient::allowance(double rays) const {
  const double learned = kAllowedFactor * (secondsPerRay_.value_or(0) + lightSecondsPerRay_);
  const double perRay = secondsPerRay_ ? learned : kAllowedPerRay;
  return (secondsPerRay_ ? kAllowedAtLeast : kAllowedBeforeFirst) +
         fromSeconds(std::min(rays * perRay, kLongestAllowance));
}

Time SchedulerClient::deadlineOf(const HeldTask& held) const {
  return *held.begun + roundTrip_ + resultsWait_ + sceneTime_ + allowance(held.rays);
}

std::optional<Time> SchedulerClient::deadline() const {
  std::optional<Time> first;
  for (const HeldTask& held : held_) {
    if (!held.begun) break;
    first = std::min(first.value_or(deadlineOf(held)), deadlineOf(held));
  }
  return first;
}

std::optional<HeldTask> SchedulerClient::overdue(Time now) const {
  std::optional<HeldTask> oldest;
  for (const HeldTask& held : held_) {
    if (!held.begun) break;
    if (deadlineOf(held) <= now && (!oldest || *held.begun < *oldest->begun)) oldest = held;
  }
  return oldest;
}

void SchedulerClient::beginTasks(Time now) {
  const size_t atWork = std::min(held_.size(), static_cast<size_t>(threads()));
  for (size_t i = 0; i < atWork; ++i)
    if (!held_[i].begun) held_[i].begun = now;
}

void SchedulerClient::becomeStuck(Time now) {
  if (!stuckSince_) ++report_.timesStuck;
  stuckSince_ = now;
}

void SchedulerClient::excuse(Duration pause) {
  for (HeldTask& held : held_)
    if (held.begun) *held.begun += pause;
  silentSince_ += pause, lastHeard_ += pause;
  if (stuckSince_) *stuckSince_ += pause;
}

void SchedulerClient::take(const HeldTask& task, Time now) {
  NINEFOLD_CHECK(!holds(task.task));
  // While views change quickly, a frozen client must not look busy just because it gets new tasks.
  if (held_.empty()) silentSince_ = owesAnswer_ ? std::max(silentSince_, lastHeard_) : now;
  held_.push_back(task);
  beginTasks(now);
  updateRefilling();
}

void SchedulerClient::answered(const TaskId& task, TaskCost cost, bool accepted, Time now) {
  cost.busy = std::clamp(cost.busy, kShortestTask, kLongestTask);
  report_.busy += cost.busy;
  report_.tasks += accepted;
  owesAnswer_ = false;
  silentSince_ = now;
  const auto found = std::ranges::find(held_, task, &HeldTask::task);
  learn(cost, found == held_.end() ? nullptr : &*found);
  if (found != held_.end()) held_.erase(found);
  beginTasks(now);
  updateRefilling();
}

void SchedulerClient::learn(TaskCost cost, const HeldTask* task) {
  // One task that met a pause of its machine must not make the client look slow for long.
  taskTime_ =
      average(taskTime_, taskTime_ ? std::min(cost.busy, kOutlier * *taskTime_) : cost.busy);
  if (task == nullptr) return;
  const double most = kLateCounts / kAllowedFactor * seconds(allowance(task->rays));
  const double perRay = std::min(seconds(cost.busy), most) / task->rays;
  secondsPerRay_ = std::max(perRay, (1 - kForget) * secondsPerRay_.value_or(0));
  if (cost.madeLight) lightSecondsPerRay_ = std::max(perRay, (1 - kForget) * lightSecondsPerRay_);
}

bool SchedulerClient::withdraw(uint32_t firstWanted, bool steps, Time now) {
  const auto count = std::erase_if(held_, [&](const HeldTask& held) {
    return held.isStep == steps && held.task.frame < firstWanted;
  });
  owesAnswer_ = owesAnswer_ || count > 0;
  beginTasks(now);
  updateRefilling();
  return count > 0;
}

void SchedulerClient::measureRoundTrip(Duration roundTrip) {
  roundTrip = std::clamp(roundTrip, Duration(0), kLongestRoundTrip);
  roundTrip_ = roundTrip_ == Duration(0) ? roundTrip : average(roundTrip_, roundTrip);
  updateRefilling();
}

void SchedulerClient::setResultsWait(Duration time) {
  resultsWait_ = time;
  updateRefilling();
}

void SchedulerClient::setTrust(Trust trust, Time now) {
  trust_ = trust;
  silentSince_ = now;
  updateRefilling();
}

void SchedulerClient::rememberSet(uint32_t randomization, int set) {
  if (randomization_ != randomization) sets_.clear();
  randomization_ = randomization;
  std::erase(sets_, set);
  sets_.push_back(set);
  if (sets_.size() > kRemembered) sets_.erase(sets_.begin());
}

bool SchedulerClient::remembersSet(uint32_t randomization, int set) const {
  return randomization == randomization_ && std::ranges::find(sets_, set) != sets_.end();
}

ClientReport SchedulerClient::report(Time now) const {
  ClientReport r = report_;
  r.suspect = trust_ != Trust::trusted;
  r.stuck = stuckSince_.has_value();
  if (!held_.empty()) r.oldest = held_.front();
  r.present = now - joined_;
  r.inFlight = inFlight();
  r.window = high();
  return r;
}

}  // namespace ninefold
