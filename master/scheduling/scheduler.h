// scheduler.h: which client gets which task, and when. A pure value: events and the time go in,
// actions come out. It knows no socket, thread or clock, so the master, the unit tests and a
// simulated cluster of a thousand clients run the same code.
//
// Policies, each in one small function:
//   order       Urgent frames: oldest first. The next frame's tasks go out before this one's last
//               are back.
//   light sets  A client goes on with a light set that it has. Its next one is a set that nobody
//               works on, in the oldest frame that has one; wantsFrame() asks for frames so that
//               one has. Clients share a set if a frame is urgent, if its sets are free, or if the
//               newest frame runs too far ahead (by kAhead more than a set for each client takes):
//               then they take the set with most tasks left per client at work on it, in the oldest
//               frame.
//   credit      A client that holds no more than `low` tasks is refilled up to `high`
//               (scheduler_client.h). No queue ever grows.
//   stragglers  When nothing is left to hand out, a client with credit gets a copy of a task that
//               is late or that it would finish sooner. There is at most one copy; the first result
//               wins. The other client's credit stays spent until its own result came.
//   lost        Its tasks go back to the front of their queues at once.
//   suspect     It holds tasks and gives no result for too long. As lost, but its results stay
//               welcome, and it gets one task on trial when it is heard of again.
//   steps       Their units are tasks of a frame without pixels, whose light costs nothing. A
//               change of the view leaves them. Each client begins with units of its own, the same
//               ones in each step, as it may have kept work of the last one; then it helps others.
//               They go out in groups. Frames are asked for beside a step that yields, although
//               its units still wait.
//   checks      Chosen results are done again by a second client of the same pixel class, before
//               any other work (verification.h). A frame does not wait for them. Actions::wrong
//               tells.
//   stuck       It is at work on a task past its deadline. As a suspect, but heartbeats do not
//               help: it gets nothing until it gives a result. Actions::notes tell.
//
// Use: after every event, and at least every 100 ms, open frames while wantsFrame() and there is
// room for them; then call poll() and carry its actions out. (In the other order poll would copy
// tasks to clients for which a new frame has work.) Call paused() after a time in which that was
// not done. Report a result after its tile was decoded. A tile that cannot be decoded ends the
// connection (clientLost), so its task is done again.
//
// Cost: O(log clients + log tasks) for an event. O(frames log clients) for each task handed out, or
// O(frames K) when the client changes its light set. O(clients frames + tasks) when a frame opens
// or a view changes. Deterministic: equal events give equal actions.
// Threads: none; one owner calls everything.
// Errors: only broken assumptions of the caller (CHECK); whatever a peer sends is a Verdict.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/sampling/interleave.h"
#include "common/scene/settings.h"
#include "master/scheduling/scheduler_frame.h"
#include "master/scheduling/scheduler_pool.h"
#include "master/scheduling/scheduler_types.h"
#include "master/scheduling/verification.h"

namespace ninefold {

class Scheduler {
 public:
  // Before the first client: a fraction of all results is done again by a second client.
  void verify(uint64_t seed, double fraction) { verification_.begin(seed, fraction); }
  // A client is ready to render. Ids are never used twice. `sceneTime`: how long it built the
  // scene.
  void clientJoined(ClientId client, int threads, Time now, Duration sceneTime = Duration(0),
                    const std::string& pixelClass = {});
  // Its connection or process ended, or its heartbeat stopped. Unknown ids are ignored.
  void clientLost(ClientId client, Time now);
  // Any message came from it: a suspect may be tried again.
  void clientHeard(ClientId client, Time now);
  // A ping was answered.
  void roundTripMeasured(ClientId client, Duration roundTrip);

  // Frames have ascending ids. A task's light set is lightSetOfPhase(phase, key.rotation, sets).
  // Tasks without pixels do not exist; whole tiles have phase 0 alone.
  void openFrame(const FrameKey& key, const TileGrid& grid, FrameKind kind = {});
  // A step of a method's state; one count of ids for frames and steps. Its tasks are
  // (number, firstUnit.., 0), each of so many rays.
  void openStep(uint32_t number, uint32_t firstUnit, int units, double rays, bool yields = false);
  // All open frames before `firstWanted` are superseded; steps are not.
  void viewChanged(uint32_t firstWanted, Time now);
  // All open steps before `firstWanted` are void; frames are not.
  void stateChanged(uint32_t firstWanted, Time now);
  // The caller itself did not run for so long, until now: no client is to blame for that.
  void paused(Duration pause);

  // `digest`: needed if needsDigest(task), once the result is to be placed or compared.
  Verdict resultArrived(ClientId client, const TaskId& task, TaskCost cost, Time now,
                        const std::optional<Digest>& digest = {});
  bool needsDigest(const TaskId& task) const {
    return verification_.isOn() && verification_.isChosen(task);
  }
  // What resultArrived would say now: lets the caller skip decoding what will be dropped.
  Verdict verdictOn(ClientId client, const TaskId& task) const;

  Actions poll(Time now);

  // Whether it is time to open the next frame: clients have credit that the open frames cannot use,
  // or only by sharing light sets without need.
  bool wantsFrame() const;
  bool isOpen(uint32_t frame) const { return frames_.contains(frame); }
  int openFrames() const;  // without steps
  int clients() const { return pool_.size(); }
  bool allAreStuck() const;  // and there is a client
  // Tasks of an open frame or step that are not done; 0 for any other.
  int tasksLeft(uint32_t frame) const;

  // Whether it is open, or a result of it is to be compared.
  bool isNeeded(uint32_t frame) const { return isOpen(frame) || verification_.isOpen(frame); }
  // All frames and steps before are done, and all their results compared, but for disputes that
  // wait for one more client.
  uint32_t firstUnsettled() const;
  // A moment to come back to, and whether all that was done up to then is trusted.
  void mark() { verification_.mark(); }
  void unmark() { verification_.unmark(); }
  bool isMarkTrusted() const { return verification_.isTrusted(); }

  const VerificationCounts& verificationCounts() const { return verification_.counts(); }
  const SchedulerCounts& counts() const { return counts_; }
  std::vector<ClientReport> report(Time now) const;  // all clients of the run, by id
  // Why a task is where it is, in words.
  std::string explain(const TaskId& task, Time now) const;
  // The open frames, each with the task that has been under way for longest; and what a client
  // works on and waits for.
  std::vector<std::string> explainFrames(Time now) const;
  std::string explainClient(ClientId client, Time now) const;
  // Aborts if the books do not balance. For tests: O(clients + tasks).
  void checkInvariants() const;

 private:
  SchedulerFrame* findFrame(uint32_t frame);
  const SchedulerFrame* findFrame(uint32_t frame) const;
  Verdict verdictOnClosed(uint32_t frame) const;
  int waiting() const;                          // tasks to hand out, over all open frames
  int waitingFirst() const;                     // without those of steps that yield
  const SchedulerFrame* newestPicture() const;  // of the open frames; null: none
  bool runsAhead() const;
  bool wouldShare() const;
  void supersede(uint32_t firstWanted, bool steps, Time now);
  struct Place {
    SchedulerFrame* frame;
    int set;
  };
  Place placeFor(const SchedulerClient& client);  // needs waiting() > 0

  void suspectSilentClients(Time now);
  void noteStuckClients(Time now);
  void doubt(SchedulerClient& client, Time now);
  void trustAgain(SchedulerClient& client, Time now);
  void handOutChecks(Actions& actions, Time now);
  void handOutWaiting(Actions& actions, Time now);
  void duplicateStragglers(Actions& actions, Time now);
  bool duplicateOne(SchedulerFrame& frame, Actions& actions, Time now);
  void assign(SchedulerClient& client, SchedulerFrame& frame, int task, Actions& actions, Time now);
  void send(SchedulerClient& client, const HeldTask& task, Actions& actions, Time now);
  void noteResult(ClientId client, const TaskId& task, const std::optional<Digest>& digest);
  void closeFrame(uint32_t frame, bool completed);
  bool isUnfinished(const TaskId& task) const;
  std::string explainOpen(const SchedulerFrame& frame, int task, Time now) const;

  SchedulerPool pool_;
  Verification verification_;
  std::map<ClientId, ClientReport> past_;         // clients that were lost
  std::map<uint32_t, SchedulerFrame> frames_;     // open ones, oldest first
  std::deque<std::pair<uint32_t, bool>> closed_;  // the latest closed ones: id, completed?
  uint32_t nextFrame_ = 0;                        // every id so far is smaller
  int pictures_ = 0;                              // frames so far, without steps
  std::vector<Cancellation> cancellations_;       // for the next poll, as the notes
  std::vector<StuckNote> notes_;
  SchedulerCounts counts_;
};

}  // namespace ninefold
