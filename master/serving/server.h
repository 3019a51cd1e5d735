// server.h: the master's network thread: it accepts clients, runs their sessions, asks the
// scheduler who gets what, and passes results on. It decodes nothing and never waits.
//
//   listener -> sessions -> scheduler -> tasks out
//   results  -> ServerDuty::take -> (elsewhere: unpacked, placed) -> decoded()
//
// Threads: everything in the loop's thread, but for the constructor and what is said below.
// Owner: main; refers to the loop, the offer and the duty, which outlive it.
// Errors: the constructor throws Error (address in use, ...). Clients' errors end their connection,
// with one line in the log, and nothing else.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/image/patch.h"
#include "master/assembly/received_tile.h"
#include "master/scheduling/frame_order.h"
#include "master/scheduling/scheduler.h"
#include "master/serving/admission.h"
#include "master/serving/client_session.h"
#include "master/serving/job_offer.h"
#include "proto/connection.h"

namespace ninefold {

struct ServerSetup {
  Endpoint listen;
  Listener::Keys keys;
  int waitClients = 1;  // no frame before that many are ready
  // This fraction of all results is done again by a second client; the seed chooses them.
  double verify = 0;
  uint64_t seed = 0;
};

// What the server is there for; called in the loop's thread, must not wait.
struct ServerDuty {
  // What is to be done next, a frame or a step; nothing when there is none or no room for it now.
  std::function<std::optional<WorkOrder>()> nextWork;
  // Takes a tile that is wanted, answered by decoded(); false when there is no room.
  std::function<bool(ReceivedTile&)> take;
  // Only newcomers are left, who have missed the open frames' job. Gives the first frame that is
  // wanted instead. Null: all frames are of one job.
  std::function<uint32_t()> giveUp = nullptr;
  // A client was found wrong, and is expelled. Gives the first frame that is wanted: all before it
  // are void. Null: nobody is verified.
  std::function<uint32_t()> goBack = nullptr;
  // Then: nothing before it is under way any more. May be null.
  std::function<void()> wentBack = nullptr;
  // A step is done: frames may be lit by version key.to of the state, which has these pages. May be
  // null.
  std::function<void(const StepKey&, const StatePages&)> stepDone = nullptr;
};

// Where a run goes on that another process has begun.
struct RunBefore {
  std::string pixelClass, isa;  // of its clients
  bool reproducible = true;     // all of them were of that class
  uint32_t state = 0;           // version of the method's state; 0: none
  StatePages pages;             // of it
};

// What the server counts; a value.
struct ServerTally {
  SchedulerCounts tasks;
  RayCounts rays;  // of accepted results
  uint64_t malformed = 0;
  uint64_t replaced = 0;  // values that were not finite, or negative, and became 0
  uint64_t bytesReceived = 0;
  std::optional<Time> firstDispatch, lastCompletion;
  Duration cpuAtDispatch{0};  // what the process had used at the first dispatch
  Duration inSteps{0};        // from a step's first dispatch to its end, summed
  uint64_t stepBytesReceived = 0, stepBytesSent = 0;  // page deltas
  bool reproducible = true;
  std::string pixelClass, isa;  // of the first client; empty: there was none
  VerificationCounts verification;
  uint64_t expelled = 0;                 // clients that were found wrong
  uint32_t firstUnsettled = 0;           // as Scheduler says
  std::optional<uint32_t> trusted = {};  // the frame that was marked last, once it is trusted
};

// One client, present or lost, for people and stats.
struct ClientInfo {
  ClientId id = 0;
  std::string name, isa, peer;
  ClientStatus status;
  std::optional<ClientReport> work;  // once it was ready
  bool isStuck() const { return work && work->stuck; }
};

class Server {
 public:
  Server(EventLoop& loop, ServerSetup setup, JobOffer& offer, ServerDuty duty);
  ~Server();

  const Endpoint& endpoint() const { return listener_->endpoint(); }
  // Before the first tick.
  void resume(const RunBefore& before);

  // Deadlines, heartbeats and work that is due. Every few tens of milliseconds.
  void tick(Time now);
  // A tile that was taken is placed in its frame; `malformed`: or could not be, for this reason.
  void decoded(const ReceivedTile& tile, const std::optional<std::string>& malformed, Time now);
  // No frame before `firstWanted` is wanted any more.
  void supersede(uint32_t firstWanted, Time now);
  // No step before `firstWanted` is.
  void cancelSteps(uint32_t firstWanted, Time now);
  // Tells in the tally when all that was done up to this frame's end is trusted.
  void mark(uint32_t frame) { markWanted_ = frame; }
  // No version of the state from this one on is forgotten.
  void keepStates(uint32_t from) { keptFrom_ = from; }
  // Says goodbye to all clients and accepts no more.
  void close(const std::string& reason);

  ServerTally tally() const;
  std::vector<ClientInfo> clients(Time now) const;
  // What the latest client of that name did; nothing before it was ready.
  std::optional<ClientReport> workOf(const std::string& name, Time now) const;
  // All clients are stuck, and none is on its way.
  bool nothingMoves() const;
  // Who is stuck where: "client 1 in frame 3, tile 5, set 2, client 2 in ..."; the first few.
  std::string stuckTasks(Time now) const;
  // What is under way and what each client waits for, line by line.
  std::vector<std::string> explain(Time now) const;
  // When the latest result came, or client became ready.
  Time lastMove() const { return lastMove_; }
  int readyClients() const { return scheduler_.clients(); }
  bool isConnected() const;  // to anybody
  // Why the run cannot go on: a version of the method's state cannot be made. Empty: it can.
  const std::string& failure() const { return failure_; }
  const Scheduler& scheduler() const { return scheduler_; }

 private:
  struct Peer {
    std::unique_ptr<ClientSession> session;
    std::shared_ptr<Connection> connection;  // null once it is over
    uint64_t bytesReceived = 0;              // of a connection that is over
    bool wasReady = false;
  };
  using Handle = std::pair<const ClientId, Peer>;

  void accept(std::shared_ptr<Connection> connection);
  void closed(ClientId id, const std::string& reason);
  bool isClosing() const { return listener_ == nullptr; }
  template <typename Event>
  void withPeer(ClientId id, Event event);  // event(session), then what follows from it
  void carryOut(Handle& peer, Time now);
  void on(Handle& peer, todo::Send&& a, Time now);
  void on(Handle& peer, todo::Warn&& a, Time now);
  void on(Handle& peer, todo::Join&& a, Time now);
  void on(Handle& peer, todo::Heard&& a, Time now);
  void on(Handle& peer, todo::RoundTrip&& a, Time now);
  void on(Handle& peer, todo::TakeResult&& a, Time now);
  void on(Handle& peer, todo::TakeUnit&& a, Time now);
  void on(Handle& peer, todo::Finish&& a, Time now);
  void lost(Handle& peer, const std::string& reason, Time now);

  void dispatchSoon();
  void dispatch(Time now);
  void letJoin(Time now);
  void giveUpOpenFrames(Time now);
  void voidBefore(uint32_t firstWanted, Time now);
  void expel(const WrongNote& note, Time now);
  void goBack(Time now);
  void settle();
  void tell(const StuckNote& note) const;
  std::string explainClient(ClientId id, const ClientSession& session, Time now) const;
  void count(const ReceivedTile& tile);
  void finishStep(uint32_t number, Time now);
  void describe(const Settings& settings);
  void sendVersion(const std::vector<msg::StateDelta>& messages, Time now);
  void dropSteps(uint32_t firstWanted, Time now);
  void announce(const JobOrder& order);
  void openFrames(Time now);
  void open(const FrameOrder& order);
  void open(const StepOrder& order, Time now);
  void forgetStates();
  void sendTasks(const std::vector<Assignment>& assignments);
  void sendUnits(const std::vector<Assignment>& assignments);
  void noteDispatch();

  EventLoop& loop_;
  const ServerSetup setup_;
  JobOffer& offer_;
  const ServerDuty duty_;
  Admission admission_;
  Scheduler scheduler_;
  std::map<ClientId, Peer> peers_;       // all of the run
  std::map<uint32_t, FrameOrder> open_;  // frames
  struct OpenStep {
    StepOrder order;
    Time since;
  };
  std::map<uint32_t, OpenStep> openSteps_;
  StateKeeper state_;
  uint32_t keptFrom_ = UINT32_MAX;               // versions
  std::optional<uint32_t> markWanted_, marked_;  // frames
  std::string described_;                        // what versions told last
  std::map<ClientId, todo::Join> joining_;  // ready; join when no open frame is of an older job
  ClientId nextId_ = 1;
  std::string failure_;
  bool started_ = false;  // waitClients were ready once
  std::optional<Time> lastDispatch_;
  Time lastMove_{};
  uint64_t spoilt_ = 0, spoiltTold_ = 0;  // tiles with values that were replaced
  ServerTally tally_;
  bool dispatchWaits_ = false;                                    // in the loop
  const std::shared_ptr<char> alive_ = std::make_shared<char>();  // for what waits in the loop
  std::unique_ptr<Listener> listener_;                            // null once the server closes
};

}  // namespace ninefold
