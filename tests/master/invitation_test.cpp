#include "master/invitation.h"

#include <gtest/gtest.h>

namespace ninefold {
namespace {

TEST(Invitation, NamesTheCommandForOtherMachines) {
  Options options;
  options.keyFile = "cluster.key";
  EXPECT_EQ(clientCommand(options, {"0.0.0.0", 4700}, "pc1"),
            "ninefold-client --master pc1:4700 --key-file cluster.key");
  EXPECT_EQ(clientCommand(options, {"10.0.0.1", 4700}, "pc1"),
            "ninefold-client --master 10.0.0.1:4700 --key-file cluster.key");
  EXPECT_EQ(clientCommand(options, {"fe80::1", 4700}, "pc1"),
            "ninefold-client --master [fe80::1]:4700 --key-file cluster.key");
  options.keyFile.reset();
  EXPECT_EQ(clientCommand(options, {"127.0.0.1", 4700}, "pc1"), std::nullopt);
}

TEST(Invitation, RefusesToWaitForClientsThatCannotCome) {
  Options options;
  options.localClients = 2, options.waitClients = 3;
  EXPECT_THROW(checkGuests(options), UsageError);
  options.waitClients = 2;
  EXPECT_NO_THROW(checkGuests(options));
  options.localClients = 0, options.waitClients = 1;
  EXPECT_THROW(checkGuests(options), UsageError);
  options.keyFile = "cluster.key";
  EXPECT_NO_THROW(checkGuests(options));
}

}  // namespace
}  // namespace ninefold
