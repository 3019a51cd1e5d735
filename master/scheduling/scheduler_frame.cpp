#include "master/scheduling/scheduler_frame.h"

#include <algorithm>
#include <optional>

#include "common/base/error.h"

namespace ninefold {

SchedulerFrame::SchedulerFrame(const FrameKey& key, const TileGrid& grid, FrameKind kind,
                               int ordinal)
    : key_(key),
      ordinal_(ordinal),
      isStep_(false),
      sharesSets_(kind.urgent || kind.freeSets),
      wholeTiles_(kind.wholeTiles),
      rays_(std::max(1.0, kind.rays)),
      sets_(grid.interleave().sets()),
      tasks_(static_cast<size_t>(grid.tasks())),
      queues_(static_cast<size_t>(sets_)) {
  for (int task = 0; task < tasks(); ++task) {
    if (grid.rect(task / sets_, task % sets_).count() == 0) continue;
    if (wholeTiles_ && task % sets_ != 0) continue;
    at(task).state = TaskState::waiting;
    queueOf(task).order.push_back(task);
    ++queueOf(task).waiting;
    ++waiting_, ++left_;
  }
}

SchedulerFrame::SchedulerFrame(uint32_t number, uint32_t firstUnit, int units, double rays,
                               bool yields, const std::vector<ClientId>& clients)
    : firstUnit_(firstUnit),
      isStep_(true),
      sharesSets_(true),
      wholeTiles_(false),
      yields_(yields),
      rays_(std::max(1.0, rays)),
      sets_(1),
      left_(units),
      waiting_(units),
      tasks_(static_cast<size_t>(units)),
      queues_(1) {
  key_.frame = number;
  queues_.front().waiting = units;
  for (int unit = 0; unit < units; ++unit) {
    at(unit).state = TaskState::waiting;
    queues_.front().order.push_back(unit);
  }
  for (size_t i = 0; i < clients.size(); ++i)
    places_[clients[i]] = static_cast<int>(i * tasks_.size() / clients.size());
}

int SchedulerFrame::indexOf(const TaskId& task) const {
  if (isStep_) {
    const uint32_t unit = static_cast<uint32_t>(task.tile) - firstUnit_;
    const bool exists = task.frame == key_.frame && task.phase == 0 && unit < tasks_.size();
    return exists ? static_cast<int>(unit) : -1;
  }
  const int tiles = tasks() / sets_;
  if (task.frame != key_.frame || task.tile < 0 || task.tile >= tiles || task.phase < 0 ||
      task.phase >= sets_)
    return -1;
  const int index = task.tile * sets_ + task.phase;
  return state(index) == TaskState::absent ? -1 : index;
}

TaskId SchedulerFrame::idOf(int task) const {
  if (isStep_) return {key_.frame, static_cast<int>(firstUnit_ + static_cast<uint32_t>(task)), 0};
  return {.frame = key_.frame, .tile = task / sets_, .phase = task % sets_};
}

std::optional<int> SchedulerFrame::setToGoOnWith(ClientId client) const {
  const auto used = setsOfClient_.find(client);
  if (used == setsOfClient_.end()) return std::nullopt;
  const auto latest = std::find_if(used->second.rbegin(), used->second.rend(),
                                   [this](int set) { return waitingOf(set) > 0; });
  if (latest == used->second.rend()) return std::nullopt;
  return *latest;
}

std::optional<int> SchedulerFrame::untouchedSet() const {
  const auto found = std::ranges::find_if(queues_, &SetQueue::isUntouched);
  if (found == queues_.end()) return std::nullopt;
  return static_cast<int>(found - queues_.begin());
}

int SchedulerFrame::untouchedSets() const {
  return static_cast<int>(std::ranges::count_if(queues_, &SetQueue::isUntouched));
}

// The set with most waiting tasks for each client at work on it, the newcomer included. In motion
// the sets that it remembers from the frame before come first.
int SchedulerFrame::setToShare(const SchedulerClient& client) const {
  std::optional<int> best;
  const auto consider = [&](int set) {
    const SetQueue& a = queues_[static_cast<size_t>(set)];
    if (a.waiting == 0) return;
    if (!best) best = set;
    const SetQueue& b = queues_[static_cast<size_t>(*best)];
    if (int64_t{a.waiting} * (b.clients + 1) > int64_t{b.waiting} * (a.clients + 1)) best = set;
  };
  for (int set = 0; set < sets_; ++set)
    if (client.remembersSet(key_.randomization, set)) consider(set);
  if (!best)
    for (int set = 0; set < sets_; ++set) consider(set);
  NINEFOLD_CHECK(best.has_value());
  return *best;
}

int SchedulerFrame::nextWaiting(int set, ClientId client) {
  if (isStep_) {
    int& place = places_[client];
    while (state(place) != TaskState::waiting) place = (place + 1) % tasks();
    return place;
  }
  std::deque<int>& order = queues_[static_cast<size_t>(set)].order;
  while (state(order.front()) != TaskState::waiting) order.pop_front();
  return order.front();
}

Time SchedulerFrame::expected(int task) const {
  const auto found = std::ranges::find_if(holders(task), &TaskHolder::active);
  NINEFOLD_CHECK(found != holders(task).end());
  return found->expected;
}

TaskHolder& SchedulerFrame::holder(int task, ClientId client) {
  const auto found = std::ranges::find(at(task).holders, client, &TaskHolder::client);
  NINEFOLD_CHECK(found != at(task).holders.end());
  return *found;
}

void SchedulerFrame::enterStraggler(int task) {
  const TaskHolder* only = nullptr;
  for (const TaskHolder& h : holders(task)) {
    if (!h.active) continue;
    if (only != nullptr) return;
    only = &h;
  }
  if (only != nullptr && state(task) == TaskState::active) stragglers_.insert({only->late, task});
}

void SchedulerFrame::leaveStraggler(int task) {
  for (const TaskHolder& h : holders(task)) stragglers_.erase({h.late, task});
}

// Brings state and counts in line with the holders after they changed. True if the task now waits.
bool SchedulerFrame::settle(int task) {
  Task& t = at(task);
  const bool held = std::ranges::any_of(t.holders, &TaskHolder::active);
  const bool waited = t.state == TaskState::waiting;
  if (held == waited) {
    t.state = held ? TaskState::active : TaskState::waiting;
    waiting_ += held ? -1 : 1;
    queueOf(task).waiting += held ? -1 : 1;
    if (!held) queueOf(task).order.push_front(task);
  }
  enterStraggler(task);
  return !held && !waited;
}

void SchedulerFrame::addHolder(int task, const TaskHolder& holder) {
  NINEFOLD_CHECK(state(task) == TaskState::waiting || state(task) == TaskState::active);
  leaveStraggler(task);
  at(task).holders.push_back(holder);
  settle(task);
}

bool SchedulerFrame::setHolderActive(int task, ClientId client, bool active) {
  if (state(task) == TaskState::done) return false;
  leaveStraggler(task);
  holder(task, client).active = active;
  return settle(task);
}

bool SchedulerFrame::removeHolder(int task, ClientId client) {
  if (state(task) == TaskState::done) return false;
  leaveStraggler(task);
  std::erase_if(at(task).holders, [&](const TaskHolder& h) { return h.client == client; });
  return settle(task);
}

void SchedulerFrame::finish(int task) {
  Task& t = at(task);
  leaveStraggler(task);
  if (t.state == TaskState::waiting) {
    --waiting_;
    --queueOf(task).waiting;
  }
  t.state = TaskState::done;
  t.holders = {};
  --left_;
}

SchedulerFrame::SetUse SchedulerFrame::useSet(ClientId client, int set) {
  std::vector<int>& used = setsOfClient_[client];
  SetUse use{.firstInFrame = used.empty(), .newSet = true};
  if (const auto found = std::ranges::find(used, set); found != used.end()) {
    use.newSet = false;
    used.erase(found);
  } else {
    ++queues_[static_cast<size_t>(set)].clients;
  }
  used.push_back(set);
  return use;
}

void SchedulerFrame::forgetClient(ClientId client) {
  const auto found = setsOfClient_.find(client);
  if (found == setsOfClient_.end()) return;
  for (const int set : found->second) --queues_[static_cast<size_t>(set)].clients;
  setsOfClient_.erase(found);
}

void SchedulerFrame::checkInvariants() const {
  int left = 0, waiting = 0;
  size_t single = 0;
  std::vector<int> waitingInSet(queues_.size());
  for (int task = 0; task < tasks(); ++task) {
    const auto active = std::ranges::count_if(holders(task), &TaskHolder::active);
    const TaskState s = state(task);
    left += s == TaskState::waiting || s == TaskState::active;
    waiting += s == TaskState::waiting;
    waitingInSet[static_cast<size_t>(setOf(task))] += s == TaskState::waiting;
    single += s == TaskState::active && active == 1;
    NINEFOLD_CHECK((s == TaskState::active) == (active > 0));
    NINEFOLD_CHECK(holders(task).empty() || s == TaskState::active || s == TaskState::waiting);
  }
  NINEFOLD_CHECK(left == left_);
  NINEFOLD_CHECK(left_ > 0);
  NINEFOLD_CHECK(waiting == waiting_);
  NINEFOLD_CHECK(single == stragglers_.size());
  for (size_t set = 0; set < queues_.size(); ++set)
    NINEFOLD_CHECK(waitingInSet[set] == queues_[set].waiting);
}

}  // namespace ninefold
