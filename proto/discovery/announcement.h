// announcement.h: a master says on the LAN where it listens (service.h), by this machine's Avahi
// daemon, as long as this object lives.
//
// It is said on the interfaces on which the master listens. Without a daemon there is one warning;
// when one comes, the master is announced.
//
// Threads: Avahi's own; constructor and destructor from one.   Owner: the run.
// Errors:  none; a warning in the log says what is to be done.
// Proved:  tests/cluster/discovery_test.py.
#pragma once

#include <memory>

#include "proto/connection.h"

namespace ninefold {

class Announcement {
 public:
  explicit Announcement(const Endpoint& listensAt);
  ~Announcement();

 private:
  class Publisher;
  std::unique_ptr<Publisher> publisher_;
};

}  // namespace ninefold
