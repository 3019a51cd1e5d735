// local_clients.h: the client processes that the master starts on its own machine, watches and
// ends.
//
// Each gets a one-time key through a pipe that stays open: the end of the pipe tells the client
// that the master is gone, so none is left behind whatever happens. A client that dies is started
// again after a pause that doubles with each crash; one that keeps dying is given up. Threads: one
// thread calls everything and lives as long as the clients (see process.h). Errors: start throws
// Error when the program cannot be started; later failures are logged and counted.
#pragma once

#include <filesystem>
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

 private:
  int crashes_ = 0;  // in a row, without a long life between
};

class LocalClients {
 public:
  struct Plan {
    std::filesystem::path program;       // ninefold-client
    std::vector<std::string> arguments;  // without the key descriptor
    std::shared_ptr<const Key> key;      // never among the arguments
    int count = 0;
  };

  explicit LocalClients(Plan plan) : plan_(std::move(plan)) {}

  void start(Time now);
  // Reaps what ended, starts what is due; call every few tens of milliseconds.
  void poll(Time now);
  // Asks all to go. Those still there when poll sees `now` beyond 600 ms later are killed.
  void stop(Time now);

  int running() const;
  // True if all have been given up: none runs and none will be started.
  bool exhausted() const;
  uint64_t crashes() const { return crashes_; }

 private:
  struct Slot {
    int number = 0;
    std::optional<ChildProcess> process;
    Time started;
    std::optional<Time> startAt;
    RestartPolicy policy;
  };
  void startOne(Slot& slot, Time now);
  void restart(Slot& slot, Time now);
  void ended(Slot& slot, const std::string& how, Time now);

  const Plan plan_;
  std::vector<Slot> slots_;
  std::optional<Time> killAt_;  // set by stop
  uint64_t crashes_ = 0;
};

}  // namespace ninefold
