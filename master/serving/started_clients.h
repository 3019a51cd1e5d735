// started_clients.h: the clients that the master starts itself, watches and ends: on its own
// machine, or on others by ssh (host_clients.h).
//
// Each gets the run's one-time key through a pipe. None is left behind whatever happens: the kernel
// kills a client whose parent is gone, the master or the ssh server, and a client that has lost its
// master ends. One that dies is started again after a pause that doubles with each crash. A local
// one is given up if it keeps dying; a host may be switched on again and never is. Either is given
// up if its own watchdog (client/watchdog.h) has ended it three times with no result in between.
// Threads: one thread calls everything and lives as long as the clients (see process.h).
// Errors: start throws Error when the program cannot be started; later failures are logged and
// counted.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/base/clock.h"
#include "common/base/process.h"
#include "proto/key.h"

namespace ninefold {

// When to start a crashed client again. Pure.
class RestartPolicy {
 public:
  explicit RestartPolicy(bool forEver = false) : forEver_(forEver) {}
  // When to start the next one; nothing if it is to be given up.
  std::optional<Time> crashed(Time started, Time now);
  // The same for one that its watchdog has ended; `gaveResults`: it had given some.
  std::optional<Time> hung(bool gaveResults, Time now);

 private:
  bool forEver_;
  int crashes_ = 0;  // in a row, without a long life between
  int hangs_ = 0;    // in a row, without a result between
};

class StartedClients {
 public:
  struct Client {
    std::string name;                    // as it tells the master
    std::string title;                   // for people: "local client 1"
    std::vector<std::string> arguments;  // of its own, after those of all
  };
  struct Plan {
    std::filesystem::path program;       // ninefold-client, or ssh
    std::vector<std::string> arguments;  // of all
    std::shared_ptr<const Key> key;      // never among the arguments
    std::vector<Client> clients;
    ChildSetup child = {};
    bool forEver = false;  // they are started again without end
  };
  // What a client, by its name, did so far.
  struct Work {
    uint64_t results = 0;
    std::string oldestTask;  // that it had not done, in words
  };
  using WorkOf = std::function<Work(const std::string& name)>;

  explicit StartedClients(Plan plan, WorkOf workOf = {})
      : plan_(std::move(plan)), workOf_(std::move(workOf)) {}

  const std::shared_ptr<const Key>& key() const { return plan_.key; }

  void start(Time now);
  // Reaps what ended, starts what is due; call every few tens of milliseconds.
  void poll(Time now);
  // Asks all to go. Those still there when poll sees `now` beyond 600 ms later are killed.
  void stop(Time now);

  int running() const;
  // True if all have been given up: none runs and none will be started.
  bool exhausted() const;
  // One was started a moment ago, or will be.
  bool isStarting(Time now) const;
  // Why the latest that hung was given up; nothing if none was.
  const std::optional<std::string>& hang() const { return hang_; }
  uint64_t crashes() const { return crashes_; }

 private:
  struct Slot {
    const Client& client;
    RestartPolicy policy;
    std::optional<ChildProcess> process = {};
    Time started = {};
    std::optional<Time> startAt = {};
  };
  void startOne(Slot& slot, Time now);
  void restart(Slot& slot, Time now);
  void ended(Slot& slot, const std::string& how, Time now);
  void hung(Slot& slot, Time now);

  const Plan plan_;
  const WorkOf workOf_;
  std::vector<Slot> slots_;
  std::optional<Time> killAt_;  // set by stop
  std::optional<std::string> hang_;
  uint64_t crashes_ = 0;
};

}  // namespace ninefold
