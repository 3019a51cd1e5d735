// master_search.h: which master a client renders for that was told none: the only one that
// announces itself on this network.
// Threads: findOnlyMaster blocks for seconds; chooseMaster is pure.
// Errors:  Error: no Avahi, none, or several, which are listed.
// Proved:  tests/client/master_search_test.cpp, tests/cluster/discovery_test.py.
#pragma once

#include <vector>

#include "proto/discovery/service.h"

namespace ninefold::client {

// Error if there is not exactly one.
const FoundMaster& chooseMaster(const std::vector<FoundMaster>& found);

// "master NAME at ADDR:PORT, release R"
std::string describe(const FoundMaster& master);

// Looks, and logs what it finds.
Endpoint findOnlyMaster();

}  // namespace ninefold::client
