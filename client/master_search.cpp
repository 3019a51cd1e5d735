#include "client/master_search.h"

#include "common/base/error.h"
#include "common/base/log.h"
#include "proto/discovery/search.h"

namespace ninefold::client {

const FoundMaster& chooseMaster(const std::vector<FoundMaster>& found) {
  if (found.empty())
    fail(
        "no master announces itself on this network; start it with --announce, or give "
        "--master ADDR:PORT");
  if (found.size() > 1)
    fail("{} masters announce themselves on this network; choose one with --master ADDR:PORT",
         found.size());
  return found.front();
}

std::string describe(const FoundMaster& master) {
  return fmt::format("master {} at {}, release {}", master.name, addressText(master.at),
                     master.release);
}

Endpoint findOnlyMaster() {
  const std::vector<FoundMaster> found = findMasters();
  for (const FoundMaster& master : found) log("found {}", describe(master));
  return chooseMaster(found).at;
}

}  // namespace ninefold::client
