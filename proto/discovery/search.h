// search.h: the masters that announce themselves on this LAN (service.h), asked of this machine's
// Avahi daemon.
//
// Anybody on the LAN can announce anything: what is found is a stranger's word until the handshake
// has proved that it has the key. Texts are made printable, and no more than kMostFound are kept.
// One master is found once, however many interfaces lead to it; by IPv4 if it has that.
//
// Threads: blocks for about a second, kLongestSearch at most; any thread.
// Errors:  Error: no Avahi daemon here.
// Proved:  tests/cluster/discovery_test.py.
#pragma once

#include <vector>

#include "common/base/clock.h"
#include "proto/discovery/service.h"

namespace ninefold {

inline constexpr size_t kMostFound = 64;
inline constexpr Duration kLongestSearch = std::chrono::seconds(4);

// By name.
std::vector<FoundMaster> findMasters();

}  // namespace ninefold
