#include "master/scheduler_client.h"

#include "common/base/error.h"

namespace ninefold {
namespace {

constexpr double kLearn = 1.0 / 8;  // weight of the newest measurement
constexpr int kOutlier = 4;         // a measurement counts as at most this many times the average
constexpr Duration kShortestTask = std::chrono::microseconds(10);
constexpr Duration kLongestTask = std::chrono::hours(1);
constexpr Duration kLongestRoundTrip = std::chrono::seconds(10);

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

void SchedulerClient::take(const TaskId& task, Time now) {
  NINEFOLD_CHECK(!holds(task));
  // While views change quickly, a frozen client must not look busy just because it gets new tasks.
  if (held_.empty()) silentSince_ = owesAnswer_ ? std::max(silentSince_, lastHeard_) : now;
  held_.push_back(task);
  updateRefilling();
}

void SchedulerClient::answered(const TaskId& task) {
  std::erase(held_, task);
  updateRefilling();
}

bool SchedulerClient::withdraw(uint32_t firstWanted) {
  const auto count = std::erase_if(held_, [&](const TaskId& t) { return t.frame < firstWanted; });
  owesAnswer_ = owesAnswer_ || count > 0;
  updateRefilling();
  return count > 0;
}

void SchedulerClient::gaveResult(Duration cost, bool accepted, Time now) {
  cost = std::clamp(cost, kShortestTask, kLongestTask);
  report_.busy += cost;
  report_.tasks += accepted;
  owesAnswer_ = false;
  // One task that met a pause of its machine must not make the client look slow for long.
  taskTime_ = average(taskTime_, taskTime_ ? std::min(cost, kOutlier * *taskTime_) : cost);
  setTrust(Trust::trusted, now);
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
  r.present = now - joined_;
  r.inFlight = inFlight();
  r.window = high();
  return r;
}

}  // namespace ninefold
