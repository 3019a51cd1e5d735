// simulated_cluster.h: a cluster without machines. Clients of any speed, lines of any latency,
// deaths and pauses, played as discrete events in simulated time around the real Scheduler.
// Deterministic, so that efficiency is a number that a test may insist on.
//
// A client works through its tasks as they came, one on each thread. It makes a light set when it
// first meets one of a randomization. At rest its results wait for each other as
// client/result_group.h says. A frozen client does nothing, and its messages wait. One that sticks
// goes on with its heartbeat. A dead one is noticed when its connection closes (after the line's
// latency), or, if its line was cut, when its heartbeat has been missing for kHeartbeatLost.
// Threads: none.   Errors: CHECKs what the scheduler promises.
#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <map>
#include <queue>
#include <set>
#include <utility>
#include <vector>

#include "common/base/error.h"
#include "master/scheduling/scheduler.h"
#include "proto/messages.h"

namespace ninefold {

inline constexpr double kHeartbeat = 1, kHeartbeatLost = 3;  // [s]
inline constexpr double kNever = 1e30;

struct SimulatedClient {
  int threads = 1;
  double speed = 1;       // work units a second and thread, 1 = the job's own figures
  double latency = 1e-4;  // one way [s]
  double joins = 0;       // [s]
  double dies = kNever;   // connection closes
  double cut = kNever;    // connection stays, nothing gets through any more
  double freezes = kNever, thaws = kNever;
  double sticks = kNever, comesBack = kNever;  // meanwhile no task ends, while heartbeats go on
  double errs = kNever;                        // from then on each result is wrong
};

struct SimulatedJob {
  TileGrid grid{640, 480, {3, 3}};
  int frames = 20;
  int framesInFlight = 16;
  bool moving = false;        // all frames share one randomization, as in motion
  double taskSeconds = 4e-3;  // 1024 pixels at 1000 frames a second and 64 clients or so
  double setSeconds = 5e-4;
  double viewChangeEvery = kNever;  // [s]; frames that it cancels do not count as completed
  uint64_t checkEvery = 10;         // events between two checks of the scheduler's books
  double rays = 1;                  // FrameKind::rays
  double verify = 0;                // fraction of results that a second client does again
};

class SimulatedCluster {
 public:
  SimulatedCluster(SimulatedJob job, std::vector<SimulatedClient> clients)
      : job_(job), clients_(clients.begin(), clients.end()) {
    scheduler_.verify(1, job.verify);
  }

  // Plays until all frames are complete, or simulated `deadline` seconds have passed.
  void run(double deadline = 1000) {
    for (size_t c = 0; c < clients_.size(); ++c)
      schedule(clients_[c].model.joins, [=, this] { join(c); });
    tick();
    if (job_.viewChangeEvery < kNever) changeView();
    while (!events_.empty() && completed_ < job_.frames && now_ < deadline) step();
  }

  bool finished() const { return completed_ == job_.frames; }
  int completed() const { return completed_; }
  double elapsed() const { return now_; }
  // Useful work over what all threads could have done while they were there: 1 if none ever paused
  // or worked in vain, light sets included once for each client and set that it must make.
  double efficiency() const {
    double capacity = 0;
    for (const Client& c : clients_) {
      const double end = std::min({now_, c.model.dies, c.model.cut});
      capacity += c.model.speed * c.model.threads * std::max(0.0, end - c.model.joins);
    }
    return usefulWork_ / capacity;
  }
  // Seconds from opening a frame to its completion, frame by frame.
  const std::vector<double>& latencies() const { return latencies_; }
  const Scheduler& scheduler() const { return scheduler_; }
  std::vector<ClientReport> reports() const { return scheduler_.report(at(now_)); }
  const std::vector<uint32_t>& completionOrder() const { return completionOrder_; }
  // Every task of a completed frame was accepted exactly once.
  bool everyTaskOnce() const { return everyTaskOnce_; }
  int mostInFlight() const { return mostInFlight_; }
  const std::vector<StuckNote>& notes() const { return notes_; }
  const std::vector<WrongNote>& wrong() const { return wrong_; }

 private:
  struct Client {
    explicit Client(const SimulatedClient& m) : model(m) {}
    SimulatedClient model;
    bool alive = false, known = false;
    int busyThreads = 0;
    std::deque<TaskId> queue;
    std::vector<std::function<void()>> results;  // that wait for others
    double handedOver = 0;
    std::set<std::pair<uint32_t, int>> sets;
  };
  struct Event {
    double time;
    uint64_t order;
    std::function<void()> act;
    bool operator<(const Event& o) const {
      return std::pair(time, order) > std::pair(o.time, o.order);
    }
  };

  static Time at(double t) { return Time(fromSeconds(t)); }
  static ClientId id(size_t c) { return static_cast<ClientId>(c + 1); }
  void schedule(double time, std::function<void()> act) {
    if (time < kNever) events_.push({time, order_++, std::move(act)});
  }
  void step() {
    const Event event = events_.top();
    events_.pop();
    now_ = event.time;
    event.act();
    carryOut();
    if (++steps_ % job_.checkEvery == 0) check();
  }

  void check() {
    scheduler_.checkInvariants();
    for (const ClientReport& r : reports()) mostInFlight_ = std::max(mostInFlight_, r.inFlight);
  }

  // The client cannot act before this time.
  double awake(const Client& c, double time) const {
    return time >= c.model.freezes && time < c.model.thaws ? c.model.thaws : time;
  }
  bool reaches(const Client& c) const { return c.alive && now_ < c.model.cut; }

  void join(size_t c) {
    Client& client = clients_[c];
    client.alive = client.known = true;
    scheduler_.clientJoined(id(c), client.model.threads, at(now_));
    scheduler_.roundTripMeasured(id(c), fromSeconds(2 * client.model.latency));
    schedule(client.model.dies, [=, this] { die(c); });
    if (client.model.cut < kNever)
      schedule(client.model.cut + kHeartbeatLost, [=, this] { lose(c); });
    heartbeat(c);
  }
  void die(size_t c) {
    clients_[c].alive = false;
    schedule(now_ + clients_[c].model.latency, [=, this] { lose(c); });
  }
  void lose(size_t c) {
    clients_[c].known = false;
    scheduler_.clientLost(id(c), at(now_));
  }
  void heartbeat(size_t c) {
    if (!reaches(clients_[c])) return;
    schedule(awake(clients_[c], now_ + kHeartbeat), [=, this] {
      if (!reaches(clients_[c])) return;
      scheduler_.clientHeard(id(c), at(now_));
      heartbeat(c);
    });
  }
  void tick() {
    schedule(now_ + 0.1, [this] { tick(); });
  }
  void changeView() {
    schedule(now_ + job_.viewChangeEvery, [this] {
      scheduler_.viewChanged(nextFrame_, at(now_));
      placed_.clear(), opened_.clear();
      changeView();
    });
  }

  void carryOut() {
    // Frames leave in their order: those behind one that is not complete take room, too.
    const auto inFlight = [this] {
      return opened_.empty() ? 0 : static_cast<int>(nextFrame_ - opened_.begin()->first);
    };
    while (inFlight() < job_.framesInFlight && scheduler_.wantsFrame()) {
      const uint32_t frame = nextFrame_++;
      opened_[frame] = now_;
      scheduler_.openFrame({.frame = frame, .randomization = job_.moving ? 0 : frame}, job_.grid,
                           {.urgent = job_.moving, .rays = job_.rays});
    }
    const Actions actions = scheduler_.poll(at(now_));
    notes_.insert(notes_.end(), actions.notes.begin(), actions.notes.end());
    for (const WrongNote& note : actions.wrong) {
      wrong_.push_back(note);
      clients_[note.client - 1].alive = false;
      lose(note.client - 1);
    }
    for (const Cancellation& cancel : actions.cancel) {
      const size_t c = cancel.client - 1;
      schedule(now_ + clients_[c].model.latency, [=, this] {
        std::erase_if(clients_[c].queue,
                      [&](const TaskId& t) { return t.frame < cancel.firstWanted; });
        handOver(c);
      });
    }
    for (const Assignment& a : actions.assign) {
      const size_t c = a.client - 1;
      const bool isWrong = std::ranges::count(actions.wrong, a.client, &WrongNote::client) > 0;
      NINEFOLD_CHECK(clients_[c].known || isWrong);  // no task for a client that is not there
      schedule(now_ + clients_[c].model.latency, [=, this] { receive(c, a.task); });
    }
  }

  void receive(size_t c, const TaskId& task) {
    if (!reaches(clients_[c])) return;
    clients_[c].queue.push_back(task);
    work(c);
  }
  void work(size_t c) {
    Client& client = clients_[c];
    while (client.alive && client.busyThreads < client.model.threads && !client.queue.empty()) {
      const TaskId task = client.queue.front();
      client.queue.pop_front();
      ++client.busyThreads;
      const uint32_t randomization = job_.moving ? 0 : task.frame;
      const bool newSet = client.sets.emplace(randomization, task.phase).second;
      const double work = taskWork(task) + (newSet ? job_.setSeconds : 0);
      const double start = awake(client, now_);
      double end = start + work / client.model.speed;
      if (start < client.model.freezes && end > client.model.freezes)
        end += client.model.thaws - client.model.freezes;
      if (start < client.model.comesBack && end > client.model.sticks)
        end = client.model.comesBack + work / client.model.speed;
      schedule(end, [=, this] { finish(c, task, work, {fromSeconds(end - start), newSet}); });
    }
  }
  void finish(size_t c, const TaskId& task, double work, TaskCost took) {
    Client& client = clients_[c];
    --client.busyThreads;
    client.results.push_back([=, this] { result(c, task, work, took); });
    const double wait = job_.moving ? 0 : seconds(kResultsTogether);
    const bool isNext = !client.queue.empty() && client.queue.front().frame == task.frame;
    if (!isNext || seconds(took.busy) >= wait || now_ - client.handedOver >= wait) handOver(c);
    this->work(c);
  }
  void handOver(size_t c) {
    Client& client = clients_[c];
    client.handedOver = now_;
    for (auto& result : std::exchange(client.results, {}))
      if (reaches(client)) schedule(now_ + client.model.latency, std::move(result));
  }
  void result(size_t c, const TaskId& task, double work, TaskCost took) {
    if (!clients_[c].known) return;
    scheduler_.clientHeard(id(c), at(now_));
    Digest digest{};
    digest[0] = now_ >= clients_[c].model.errs;
    const Verdict verdict = scheduler_.resultArrived(id(c), task, took, at(now_), digest);
    if (!isAccepted(verdict)) return;
    usefulWork_ += work;
    auto& placed = placed_[task.frame];
    everyTaskOnce_ &= placed.emplace(task.tile, task.phase).second;
    if (verdict != Verdict::completedFrame) return;
    everyTaskOnce_ &= static_cast<int>(placed.size()) == tasksWithPixels();
    placed_.erase(task.frame);
    latencies_.push_back(now_ - opened_.at(task.frame));
    opened_.erase(task.frame);
    completionOrder_.push_back(task.frame);
    ++completed_;
  }

  // Tasks differ by up to a factor of three, the same for all clients.
  double taskWork(const TaskId& t) const {
    const uint32_t h = (static_cast<uint32_t>(t.tile) * 2654435761u) >> 16;
    return job_.taskSeconds * (0.5 + (h % 1024) / 1024.0);
  }
  int tasksWithPixels() const {
    int count = 0;
    for (int tile = 0; tile < job_.grid.tiles(); ++tile)
      for (int phase = 0; phase < job_.grid.interleave().sets(); ++phase)
        count += job_.grid.rect(tile, phase).count() > 0;
    return count;
  }

  SimulatedJob job_;
  std::vector<Client> clients_;
  Scheduler scheduler_;
  std::priority_queue<Event> events_;
  uint64_t order_ = 0, steps_ = 0;
  double now_ = 0, usefulWork_ = 0;
  uint32_t nextFrame_ = 0;
  int completed_ = 0, mostInFlight_ = 0;
  bool everyTaskOnce_ = true;
  std::vector<StuckNote> notes_;
  std::vector<WrongNote> wrong_;
  std::map<uint32_t, std::set<std::pair<int, int>>> placed_;
  std::vector<uint32_t> completionOrder_;
  std::map<uint32_t, double> opened_;  // when
  std::vector<double> latencies_;
};

}  // namespace ninefold
