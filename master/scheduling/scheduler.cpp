#include "master/scheduling/scheduler.h"

#include <algorithm>

#include "common/base/error.h"
#include "proto/messages.h"

namespace ninefold {
namespace {

constexpr size_t kRememberedFrames = 64;  // closed ones, to tell duplicate from stale
constexpr Duration kShortestEstimate = milliseconds(5);  // below that it is jitter, not lateness
constexpr int kLateFactor = 2;                           // late: took this many times the estimate
constexpr int kAhead = 3;  // frames beyond those in which each client has a set of its own

}  // namespace

void Scheduler::clientJoined(ClientId id, int threads, Time now, Duration sceneTime,
                             const std::string& pixelClass) {
  NINEFOLD_CHECK(!past_.contains(id));
  verification_.joined(id, pixelClass);
  pool_.add(id, threads, now);
  SchedulerClient& client = *pool_.find(id);
  client.setSceneTime(sceneTime);
  pool_.update(client);
}

void Scheduler::clientLost(ClientId id, Time now) {
  const SchedulerClient* client = pool_.find(id);
  if (client == nullptr) return;
  for (const HeldTask& held : client->held())
    if (SchedulerFrame* frame = findFrame(held.task.frame))
      counts_.reissued += frame->removeHolder(frame->indexOf(held.task), id);
  for (auto& [number, frame] : frames_) frame.forgetClient(id);
  ClientReport report = client->report(now);
  report.lost = true;
  report.stuck = false;
  report.inFlight = report.window = 0;
  past_.emplace(id, report);
  pool_.remove(id);
  verification_.lost(id);
}

void Scheduler::clientHeard(ClientId id, Time now) {
  SchedulerClient* client = pool_.find(id);
  if (client == nullptr) return;
  client->heard(now);
  if (client->trust() != Trust::suspect || client->inFlight() > 0) return;
  // Not soon, if it is stuck: it may still be at work on a task that was withdrawn.
  if (const auto since = client->stuckSince())
    if (now - std::max(*since, client->silentSince()) < SchedulerClient::kRetryStuck) return;
  client->setTrust(Trust::trial, now);
  pool_.update(*client);
}

void Scheduler::roundTripMeasured(ClientId id, Duration roundTrip) {
  SchedulerClient* client = pool_.find(id);
  if (client == nullptr) return;
  client->measureRoundTrip(roundTrip);
  pool_.update(*client);
}

SchedulerFrame* Scheduler::findFrame(uint32_t frame) {
  const auto found = frames_.find(frame);
  return found == frames_.end() ? nullptr : &found->second;
}

const SchedulerFrame* Scheduler::findFrame(uint32_t frame) const {
  const auto found = frames_.find(frame);
  return found == frames_.end() ? nullptr : &found->second;
}

int Scheduler::tasksLeft(uint32_t frame) const {
  const SchedulerFrame* found = findFrame(frame);
  return found == nullptr ? 0 : found->left();
}

int Scheduler::waiting() const {
  int sum = 0;
  for (const auto& [number, frame] : frames_) sum += frame.waiting();
  return sum;
}

int Scheduler::waitingFirst() const {
  int sum = 0;
  for (const auto& [number, frame] : frames_) sum += frame.yields() ? 0 : frame.waiting();
  return sum;
}

bool Scheduler::isAwaited() const {
  return std::ranges::any_of(frames_, [](const auto& f) {
    return !f.second.isStep() && f.second.sharesSets() && f.second.waiting() > 0;
  });
}

bool Scheduler::wantsFrame() const {
  return !verification_.isFull() && (waitingFirst() < pool_.freeCredit() || wouldShare());
}

int Scheduler::openFrames() const {
  return static_cast<int>(
      std::ranges::count_if(frames_, [](const auto& f) { return !f.second.isStep(); }));
}

const SchedulerFrame* Scheduler::newestPicture() const {
  for (auto frame = frames_.rbegin(); frame != frames_.rend(); ++frame)
    if (!frame->second.isStep()) return &frame->second;
  return nullptr;
}

// Frames leave in their order: those that are complete behind one that is not are ahead, too.
bool Scheduler::runsAhead() const {
  const SchedulerFrame* newest = newestPicture();
  if (newest == nullptr) return false;
  const auto oldest =
      std::ranges::find_if(frames_, [](const auto& f) { return !f.second.isStep(); });
  const int needed = (clients() + newest->sets() - 1) / newest->sets();
  return pictures_ - oldest->second.ordinal() >= needed + kAhead;
}

// Clients have credit left after the sets that they go on with, and want more new sets than there
// are.
bool Scheduler::wouldShare() const {
  const SchedulerFrame* newest = newestPicture();
  if (newest == nullptr || newest->sharesSets() || runsAhead()) return false;
  int untouched = 0;
  for (const auto& [number, frame] : frames_) untouched += frame.untouchedSets();
  for (const auto& [time, client] : pool_.ready()) {
    int credit = pool_.find(client)->credit();
    for (const auto& [number, frame] : frames_)
      if (const auto set = frame.setToGoOnWith(client)) credit -= frame.waitingOf(*set);
    for (; credit > 0; credit -= newest->tasksOfSet())
      if (--untouched < 0) return true;
  }
  return false;
}

void Scheduler::openFrame(const FrameKey& key, const TileGrid& grid, FrameKind kind) {
  NINEFOLD_CHECK(key.frame >= nextFrame_);
  frames_.emplace(key.frame, SchedulerFrame(key, grid, kind, pictures_++));
  pool_.setResultsWait(kind.urgent ? Duration(0) : kResultsTogether);
  nextFrame_ = key.frame + 1;
}

void Scheduler::openStep(uint32_t number, uint32_t firstUnit, int units, double rays, bool yields) {
  NINEFOLD_CHECK(number >= nextFrame_);
  NINEFOLD_CHECK(units > 0);
  std::vector<ClientId> clients;
  pool_.forEach([&](const SchedulerClient& client) { clients.push_back(client.id()); });
  frames_.emplace(number, SchedulerFrame(number, firstUnit, units, rays, yields, clients));
  pool_.setResultsWait(kResultsTogether);
  nextFrame_ = number + 1;
}

void Scheduler::viewChanged(uint32_t firstWanted, Time now) { supersede(firstWanted, false, now); }

void Scheduler::stateChanged(uint32_t firstWanted, Time now) { supersede(firstWanted, true, now); }

void Scheduler::supersede(uint32_t firstWanted, bool steps, Time now) {
  std::vector<uint32_t> ended;
  for (const auto& [number, frame] : frames_)
    if (number < firstWanted && frame.isStep() == steps) ended.push_back(number);
  for (const uint32_t number : ended) {
    counts_.cancelledTasks += static_cast<uint64_t>(tasksLeft(number));
    counts_.cancelledFrames += steps ? 0 : 1;
    closeFrame(number, false);
  }
  verification_.drop(firstWanted, steps);
  pool_.change([&](SchedulerClient& client) {
    const bool held = client.withdraw(firstWanted, steps, now);
    if (held) cancellations_.push_back({client.id(), firstWanted, steps});
    return held;
  });
}

void Scheduler::paused(Duration pause) {
  pool_.change([pause](SchedulerClient& client) { return client.excuse(pause), true; });
}

bool Scheduler::allAreStuck() const {
  bool all = clients() > 0;
  pool_.forEach([&](const SchedulerClient& client) { all &= client.stuckSince().has_value(); });
  return all;
}

void Scheduler::closeFrame(uint32_t frame, bool completed) {
  const bool isStep = frames_.at(frame).isStep();
  counts_.completedFrames += completed && !isStep;
  counts_.completedSteps += completed && isStep;
  frames_.erase(frame);
  closed_.emplace_back(frame, completed);
  if (closed_.size() > kRememberedFrames) closed_.pop_front();
}

Verdict Scheduler::verdictOnClosed(uint32_t frame) const {
  if (frame >= nextFrame_) return Verdict::unknown;
  for (const auto& [number, completed] : closed_)
    if (number == frame) return completed ? Verdict::duplicate : Verdict::stale;
  return Verdict::stale;
}

Verdict Scheduler::verdictOn(ClientId id, const TaskId& task) const {
  const SchedulerClient* client = pool_.find(id);
  if (client == nullptr) return past_.contains(id) ? Verdict::stale : Verdict::unknown;
  if (verification_.expects(id, task)) return Verdict::compared;
  const SchedulerFrame* frame = findFrame(task.frame);
  if (frame == nullptr) return verdictOnClosed(task.frame);
  const int index = frame->indexOf(task);
  if (index < 0) return Verdict::unknown;
  if (frame->state(index) == TaskState::done) return Verdict::duplicate;
  if (!client->holds(task)) return Verdict::unknown;
  return frame->left() == 1 ? Verdict::completedFrame : Verdict::accepted;
}

Verdict Scheduler::resultArrived(ClientId id, const TaskId& task, TaskCost cost, Time now,
                                 const std::optional<Digest>& digest) {
  const Verdict verdict = verdictOn(id, task);
  counts_.droppedUnknown += verdict == Verdict::unknown;
  counts_.droppedDuplicate += verdict == Verdict::duplicate;
  counts_.droppedStale += verdict == Verdict::stale;
  SchedulerClient* const known = pool_.find(id);
  if (verdict == Verdict::unknown || known == nullptr) return verdict;

  SchedulerClient& client = *known;
  client.answered(task, cost, isAccepted(verdict), now);
  trustAgain(client, now);
  pool_.update(client);
  if (verdict == Verdict::compared) verification_.answered(id, task, digest.value());
  if (!isAccepted(verdict)) return verdict;

  ++counts_.accepted;
  noteResult(id, task, digest);
  SchedulerFrame& frame = *findFrame(task.frame);
  counts_.completedUnits += frame.isStep();
  frame.finish(frame.indexOf(task));
  if (verdict == Verdict::completedFrame) closeFrame(task.frame, true);
  return verdict;
}

// A suspect that gives a result will finish what it still holds: its claims count again. Not so one
// that is stuck, while another of its threads is.
void Scheduler::trustAgain(SchedulerClient& client, Time now) {
  if (const auto since = client.stuckSince()) {
    if (client.overdue(now)) return;
    notes_.push_back({.client = client.id(), .isBack = true, .time = now - *since});
    client.becomeUnstuck();
  }
  if (client.trust() == Trust::suspect)
    for (const HeldTask& held : client.held())
      if (SchedulerFrame* frame = findFrame(held.task.frame))
        frame->setHolderActive(frame->indexOf(held.task), client.id(), true);
  client.setTrust(Trust::trusted, now);
}

Actions Scheduler::poll(Time now) {
  Actions actions;
  suspectSilentClients(now);
  noteStuckClients(now);
  handOutChecks(actions, now);
  handOutWaiting(actions, now);
  duplicateStragglers(actions, now);
  actions.cancel.swap(cancellations_);
  actions.notes.swap(notes_);
  actions.wrong = verification_.takeWrong();
  return actions;
}

void Scheduler::suspectSilentClients(Time now) {
  while (const auto id = pool_.silent(now)) doubt(*pool_.find(*id), now);
}

void Scheduler::noteStuckClients(Time now) {
  while (const auto id = pool_.overdue(now)) {
    SchedulerClient& client = *pool_.find(*id);
    const HeldTask task = *client.overdue(now);
    notes_.push_back({.client = *id, .time = now - *task.begun, .task = task});
    client.becomeStuck(now);
    counts_.clientsStuck += client.counts().timesStuck == 1;
    doubt(client, now);
  }
}

// What it holds goes to others, too.
void Scheduler::doubt(SchedulerClient& client, Time now) {
  if (client.trust() != Trust::suspect) {
    client.setTrust(Trust::suspect, now);
    for (const HeldTask& held : client.held())
      if (SchedulerFrame* frame = findFrame(held.task.frame))
        counts_.reissued += frame->setHolderActive(frame->indexOf(held.task), client.id(), false);
    for (auto& [number, frame] : frames_) frame.forgetClient(client.id());
    verification_.release(client.id());
  }
  pool_.update(client);
}

// Task by task to whoever would finish it first, so that a short supply is spread over all. Units
// of steps go in groups; the last ones are spread, too.
void Scheduler::handOutWaiting(Actions& actions, Time now) {
  while (waiting() > 0 && !pool_.ready().empty()) {
    SchedulerClient& client = *pool_.find(pool_.ready().begin()->second);
    const auto [frame, set] = placeFor(client);
    const int share = std::max(1, frame->waiting() / (2 * clients()));
    const int group = frame->isStep() ? std::min(client.unitsAtOnce(), share) : 1;
    for (int i = 0; i < group; ++i)
      assign(client, *frame, frame->nextWaiting(set, client.id()), actions, now);
  }
}

Scheduler::Place Scheduler::placeFor(const SchedulerClient& client) {
  SchedulerFrame* oldest = nullptr;
  const bool yield = isAwaited();
  for (auto& [number, frame] : frames_) {
    if (yield && frame.yields()) continue;
    if (const auto set = frame.setToGoOnWith(client.id())) return {&frame, *set};
    if (oldest == nullptr && frame.waiting() > 0) oldest = &frame;
    if (oldest == &frame && frame.sharesSets()) return {&frame, frame.setToShare(client)};
  }
  if (!runsAhead())
    for (auto& [number, frame] : frames_)
      if (const auto set = frame.untouchedSet()) return {&frame, *set};
  return {oldest, oldest->setToShare(client)};
}

void Scheduler::duplicateStragglers(Actions& actions, Time now) {
  if (waiting() > 0) return;
  for (auto& [number, frame] : frames_)
    while (duplicateOne(frame, actions, now)) {
    }
}

// A task with one holder is worth a copy if it is late, or if the other client would be quicker.
// Its holder may be the quickest client itself, so the two quickest are asked; each holds few
// tasks.
bool Scheduler::duplicateOne(SchedulerFrame& frame, Actions& actions, Time now) {
  const auto& stragglers = frame.stragglers();
  int asked = 0;
  for (auto ready = pool_.ready().begin(); ready != pool_.ready().end() && asked < 2;
       ++ready, ++asked) {
    SchedulerClient& client = *pool_.find(ready->second);
    const auto isOthers = [&](const auto& straggler) {
      return std::ranges::count(frame.holders(straggler.second), client.id(),
                                &TaskHolder::client) == 0;
    };
    const auto latest = std::ranges::find_if(stragglers, isOthers);
    if (latest == stragglers.end()) continue;
    const auto farthest = std::find_if(stragglers.rbegin(), stragglers.rend(), isOthers);
    const bool quicker = now + ready->first < frame.expected(farthest->second);
    if (latest->first > now && !quicker) continue;
    ++counts_.duplicated;
    assign(client, frame, latest->first <= now ? latest->second : farthest->second, actions, now);
    return true;
  }
  return false;
}

void Scheduler::assign(SchedulerClient& client, SchedulerFrame& frame, int task, Actions& actions,
                       Time now) {
  const Duration estimate = client.timeForOneMore();
  frame.addHolder(task, {.client = client.id(),
                         .sent = now,
                         .expected = now + estimate,
                         .late = now + kLateFactor * std::max(estimate, kShortestEstimate)});
  const int set = frame.setOf(task);
  const auto use = frame.useSet(client.id(), set);
  if (!frame.isStep()) {
    client.counts().frames += use.firstInFrame;
    client.counts().lightSets += use.newSet;
    client.rememberSet(frame.key().randomization, set);
  }
  send(client, frame.heldTask(task), actions, now);
}

void Scheduler::send(SchedulerClient& client, const HeldTask& task, Actions& actions, Time now) {
  client.take(task, now);
  pool_.update(client);
  ++counts_.assigned;
  actions.assign.push_back({client.id(), task.task, client.allowance(task.rays)});
}

}  // namespace ninefold
