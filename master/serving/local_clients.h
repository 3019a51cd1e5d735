// local_clients.h: the client processes that the master starts on its own machine, watches and
// ends.
//
// Each gets a one-time key through a pipe. The pipe stays open; its end tells the client that the
// master is gone, so none is left behind whatever happens. A client that dies is started again
// after a pause that doubles with each crash. It is given up if it keeps dying, or if its own
// watchdog (client/watchdog.h) has ended it three times with no result in between.
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
  // When to start the next one; nothing if it is to be given up.
  std::optional<Time> crashed(Time started, Time now);
  // The same for one that its watchdog has ended; `gaveResults`: it had given some.
  std::optional<Time> hung(bool gaveResults, Time now);

 private:
  int crashes_ = 0;  // in a row, without a long life between
  int hangs_ = 0;    // in a row, without a result between
};

class LocalClients {
 public:
  struct Plan {
    std::filesystem::path program;       // ninefold-client
    std::vector<std::string> arguments;  // without the key descriptor
    std::shared_ptr<const Key> key;      // never among the arguments
    int count = 0;
  };
  // What a client, by its name, did so far.
  struct Work {
    uint64_t results = 0;
    std::string oldestTask;  // that it had not done, in words
  };
  using WorkOf = std::function<Work(const std::string& name)>;

  explicit LocalClients(Plan plan, WorkOf workOf = {})
      : plan_(std::move(plan)), workOf_(std::move(workOf)) {}

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
    int number = 0;
    std::string name() const { return "local" + std::to_string(number); }
    std::optional<ChildProcess> process;
    Time started;
    std::optional<Time> startAt;
    RestartPolicy policy;
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
