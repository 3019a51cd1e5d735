// Which of the masters that announce themselves a client takes; the network itself is in
// tests/cluster/discovery_test.py.
#include "client/master_search.h"

#include <gtest/gtest.h>

#include "common/base/error.h"

namespace ninefold::client {
namespace {

const FoundMaster kOne{"render1", "0.1.0+abc", {"10.0.0.1", 4700}};
const FoundMaster kOther{"render2", "0.1.0+abc", {"fd00::2", 4701}};

std::string problemOf(const std::vector<FoundMaster>& found) {
  try {
    chooseMaster(found);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(MasterSearch, TakesTheOnlyOne) { EXPECT_EQ(chooseMaster({kOne}).name, "render1"); }

TEST(MasterSearch, ChoosesForNobody) {
  EXPECT_NE(problemOf({}).find("start it with --announce"), std::string::npos);
  EXPECT_NE(problemOf({kOne, kOther}).find("2 masters"), std::string::npos);
  EXPECT_NE(problemOf({kOne, kOther}).find("--master ADDR:PORT"), std::string::npos);
}

TEST(MasterSearch, ListsWhatIsToBeTyped) {
  EXPECT_EQ(describe(kOther), "master render2 at [fd00::2]:4701, release 0.1.0+abc");
}

}  // namespace
}  // namespace ninefold::client
