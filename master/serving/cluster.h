// cluster.h: the network thread with all that lives in it: event loop, server, the clients
// that it starts, signals, and the ticking of their deadlines.
//
// SIGUSR1 asks for the picture so far: takeSaveRequest() tells the run. SIGUSR2 asks what is under
// way: the log gets lines that begin with "state:". Only the network thread takes them. main blocks
// them for all others, else they would end the program before that thread runs, or after.
//
// Threads: the constructor listens, start() begins the thread; everything else from any thread, but
// the server's tally and clients only after join().
// Owner: main; ends and joins when destroyed.
// Errors: the constructor throws Error (cannot listen). failure() tells what ends the run later.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "master/scheduling/stall_watch.h"
#include "master/serving/host_clients.h"
#include "master/serving/server.h"
#include "master/serving/started_clients.h"

namespace ninefold {

struct ClusterSetup {
  ServerSetup server;
  StartedClients::Plan local;  // without the master's address, which only listening tells
  std::vector<Host> hosts = {};
  std::string isa = "auto";               // of clients on hosts
  bool remoteMayJoin = false;             // a cluster key exists
  bool savesOnRequest = false;            // the run asks takeSaveRequest()
  std::optional<Duration> patience = {};  // with clients that are all stuck; none: without end
};

class Cluster {
 public:
  Cluster(ClusterSetup setup, JobOffer& offer, ServerDuty duty);
  ~Cluster();

  const Endpoint& endpoint() const { return server_.endpoint(); }
  // Before start().
  void resume(const RunBefore& before) { server_.resume(before); }
  void start();

  // No frame before `firstWanted` is wanted any more.
  void supersede(uint32_t firstWanted);
  // No step before `firstWanted` is.
  void cancelSteps(uint32_t firstWanted);
  // As Server says.
  void mark(uint32_t frame);
  void keepStates(uint32_t from);
  // There may be a frame to open that was not there before.
  void wake();

  // A tile was placed, or could not be.
  void decoded(ReceivedTile&& tile, const std::optional<std::string>& malformed);

  // The first of endingSignals(), 0 if none came. A second SIGINT or SIGTERM ends the program at
  // once.
  int signal() const { return signal_; }
  // Whether somebody asked for the picture so far; once for each time, or for a few.
  bool takeSaveRequest() { return saveAsked_.exchange(false); }
  // Why the run cannot go on, if it cannot.
  std::optional<std::string> failure() const;
  // What the clients are doing, for people: "2 ready, 1 syncing 63%".
  std::string summary() const;
  std::optional<Time> firstDispatch() const;
  // As of the last tick.
  std::vector<ClientInfo> clients() const;
  ServerTally tally() const;

  // Begins to end: goodbye to all, no process left within a second. Does not wait.
  void stop(const std::string& reason);
  void join();

  // After join().
  const Server& server() const { return server_; }
  uint64_t stalls() const { return stall_.stalls(); }

 private:
  void run();
  void tick();
  void watchSignals();
  void askForSave();
  void tellState() const;
  bool isOver(Time now) const;
  void fail(const std::string& line);
  void watchForStall(Time now);
  bool othersMayJoin() const;
  void failWithoutClients();
  StartedClients::Work workOf(const std::string& name) const;
  std::string describeClients() const;  // needs the lock

  EventLoop loop_;
  const bool remoteMayJoin_, hasHosts_, savesOnRequest_;
  Server server_;
  StartedClients local_, hosts_;
  StallWatch stall_;
  std::unique_ptr<EventLoop::Timer> timer_;
  std::optional<Time> endBy_;  // set by stop
  std::atomic<int> signal_ = 0;
  std::atomic<bool> saveAsked_ = false;
  int asked_ = 0;  // to end, by people; the loop's thread

  mutable std::mutex mutex_;
  std::optional<std::string> failure_;  // guarded by mutex_
  std::string summary_;                 // guarded by mutex_
  std::optional<Time> firstDispatch_;   // guarded by mutex_
  std::vector<ClientInfo> clients_;     // guarded by mutex_
  ServerTally tally_;                   // guarded by mutex_
  struct Decoded {
    ReceivedTile tile;
    std::optional<std::string> malformed;
  };
  std::vector<Decoded> decoded_;  // guarded by mutex_; what the loop has not seen yet

  std::thread thread_;
};

}  // namespace ninefold
