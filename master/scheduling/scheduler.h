// scheduler.h: which client gets which task, and when. A pure value: it eats events and the time
// and gives back actions; it knows no socket, thread or clock, so the master, the unit tests and a
// simulated cluster of a thousand clients all run the same code.
//
// Policies, each in one small function:
//   order       in urgent frames oldest first; the next frame's tasks go out before this one's last
//               are back
//   light sets  a client goes on with light sets that it has. The next one is of the oldest frame that
//               has one which nobody is at work on, and frames are opened so that there is one. In
//               frames that are urgent or whose sets are free, and when the newest frame is kAhead further
//               ahead than it takes to give each client a set of its own, clients share: the set with
//               most tasks left per client at work on it, of the oldest frame
//   credit      a client that holds less than `low` tasks is refilled up to `high`; both cover its
//               round trip and the time that results wait for others at its learned speed
//               (scheduler_client.h). No queue ever grows.
//   stragglers  nothing left to hand out: a client with credit gets a copy of a task that is late
//               or that it would finish sooner. At most one copy; the first result wins. The other
//               client's credit stays spent until its own result came.
//   lost        tasks go back to the front of their queue at once
//   suspect     a client that holds tasks and gives no result for too long: as lost, but its
//               results stay welcome, and it gets one task on trial when it is heard of again
//   stuck       a client at work on a task past its deadline (scheduler_client.h): as a suspect, but
//               heartbeats do not help: it gets nothing until it gives a result. Actions::notes say so
//
// Use: after every event, and at least every 100 ms, open frames while wantsFrame() and there is
// room for them, then call poll() and carry its actions out. (The other way round, poll would copy
// tasks to clients for which a new frame has work.) Tell of pauses in which that could not be done.
// A result is reported after its tile was decoded; a tile that cannot be decoded ends the
// connection (clientLost), so its task is done again.
//
// Cost: an event O(log clients + log tasks), and for each task handed out O(frames log clients), or
// O(frames K) when a client changes its light set; O(clients frames + tasks) when a frame opens or
// a view changes. Deterministic: equal events give equal actions.
// Threads: none; one owner calls everything.
// Errors: only broken assumptions of the caller (CHECK); whatever a peer sends is a Verdict.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "common/sampling/interleave.h"
#include "common/scene/settings.h"
#include "master/scheduling/scheduler_frame.h"
#include "master/scheduling/scheduler_pool.h"
#include "master/scheduling/scheduler_types.h"

namespace ninefold {

class Scheduler {
 public:
  // A client is ready to render. Ids are never used twice. `sceneTime`: that it took to build the
  // scene.
  void clientJoined(ClientId client, int threads, Time now, Duration sceneTime = Duration(0));
  // Its connection or process ended, or its heartbeat stopped. Unknown ids are ignored.
  void clientLost(ClientId client, Time now);
  // Any message came from it: a suspect may be tried again.
  void clientHeard(ClientId client, Time now);
  // A ping was answered.
  void roundTripMeasured(ClientId client, Duration roundTrip);

  // Frames have ascending ids. Light sets of tasks: lightSetOfPhase(phase, key.rotation, sets).
  // Tasks without pixels do not exist; of whole tiles, there is phase 0 alone.
  void openFrame(const FrameKey& key, const TileGrid& grid, FrameKind kind = {});
  // All open frames before `firstWanted` are superseded.
  void viewChanged(uint32_t firstWanted, Time now);
  // The caller itself did not run for so long, until now: no client is to blame for that.
  void paused(Duration pause);

  Verdict resultArrived(ClientId client, const TaskId& task, TaskCost cost, Time now);
  // What resultArrived would say now: lets the caller skip decoding what will be dropped.
  Verdict verdictOn(ClientId client, const TaskId& task) const;

  Actions poll(Time now);

  // True while clients have credit that the open frames cannot use, or can use only by sharing
  // light sets that need not be shared: time to open the next frame.
  bool wantsFrame() const;
  bool isOpen(uint32_t frame) const { return frames_.contains(frame); }
  int openFrames() const { return static_cast<int>(frames_.size()); }
  int clients() const { return pool_.size(); }
  bool allAreStuck() const;  // and there is a client
  // Tasks of an open frame that are not done; 0 for any other frame.
  int tasksLeft(uint32_t frame) const;

  const SchedulerCounts& counts() const { return counts_; }
  std::vector<ClientReport> report(Time now) const;  // all clients of the run, by id
  // Why a task is where it is, in words.
  std::string explain(const TaskId& task, Time now) const;
  // The open frames, each with the task that has been under way for longest; what a client is at,
  // and waits for.
  std::vector<std::string> explainFrames(Time now) const;
  std::string explainClient(ClientId client, Time now) const;
  // Aborts if the books do not balance. For tests: O(clients + tasks).
  void checkInvariants() const;

 private:
  SchedulerFrame* findFrame(uint32_t frame);
  const SchedulerFrame* findFrame(uint32_t frame) const;
  Verdict verdictOnClosed(uint32_t frame) const;
  int waiting() const;     // tasks to hand out, over all open frames
  bool runsAhead() const;  // needs an open frame
  bool wouldShare() const;
  struct Place {
    SchedulerFrame* frame;
    int set;
  };
  Place placeFor(const SchedulerClient& client);  // needs waiting() > 0

  void suspectSilentClients(Time now);
  void noteStuckClients(Time now);
  void doubt(SchedulerClient& client, Time now);
  void trustAgain(SchedulerClient& client, Time now);
  void handOutWaiting(Actions& actions, Time now);
  void duplicateStragglers(Actions& actions, Time now);
  bool duplicateOne(SchedulerFrame& frame, Actions& actions, Time now);
  void assign(SchedulerClient& client, SchedulerFrame& frame, int task, Actions& actions, Time now);
  void closeFrame(uint32_t frame, bool completed);
  bool isUnfinished(const TaskId& task) const;
  std::string explainOpen(const SchedulerFrame& frame, int task, Time now) const;

  SchedulerPool pool_;
  std::map<ClientId, ClientReport> past_;         // clients that were lost
  std::map<uint32_t, SchedulerFrame> frames_;     // open ones, oldest first
  std::deque<std::pair<uint32_t, bool>> closed_;  // the latest closed ones: id, completed?
  uint32_t nextFrame_ = 0;                        // every frame id so far is smaller
  std::vector<Cancellation> cancellations_;       // for the next poll, as the notes
  std::vector<StuckNote> notes_;
  SchedulerCounts counts_;
};

}  // namespace ninefold
