#include "master/running/invitation.h"

#include <gtest/gtest.h>

namespace ninefold {
namespace {

// Not inlined: GCC 12 takes the empty path for one that is not initialized.
[[gnu::noinline]] void setKeyFile(Options& options) { options.keyFile = "cluster.key"; }

// What is to be typed, line by line.
std::vector<std::string> commands(const Options& options, const Endpoint& at,
                                  const std::vector<std::string>& addresses = {}) {
  std::vector<std::string> found;
  for (const std::string& line : invitation(options, at, addresses))
    if (const size_t begin = line.find("ninefold-client"); begin != std::string::npos)
      found.push_back(line.substr(begin));
  return found;
}

using Lines = std::vector<std::string>;

TEST(Invitation, NamesAnAddressThatWorksElsewhere) {
  Options options;
  setKeyFile(options);
  EXPECT_EQ(commands(options, {"10.0.0.1", 4700}, {"192.0.2.7"}),
            Lines{"ninefold-client --master 10.0.0.1:4700 --key-file cluster.key"});
  EXPECT_EQ(commands(options, {"fd00::1", 4700}),
            Lines{"ninefold-client --master [fd00::1]:4700 --key-file cluster.key"});
  EXPECT_EQ(commands(options, {"0.0.0.0", 4700}, {"192.0.2.7", "10.1.0.2"}),
            (Lines{"ninefold-client --master 192.0.2.7:4700 --key-file cluster.key",
                   "ninefold-client --master 10.1.0.2:4700 --key-file cluster.key"}));
  EXPECT_EQ(commands(options, {"::", 4700}, {"192.0.2.7", "2001:db8::7"}),
            (Lines{"ninefold-client --master 192.0.2.7:4700 --key-file cluster.key",
                   "ninefold-client --master [2001:db8::7]:4700 --key-file cluster.key"}));
}

TEST(Invitation, SaysWhenNobodyElsewhereCanCome) {
  Options options;
  EXPECT_EQ(invitation(options, {"127.0.0.1", 4700}, {}), Lines{"listening on 127.0.0.1:4700"});
  setKeyFile(options);
  const std::string alone = invitation(options, {"0.0.0.0", 4700}, {}).back();
  EXPECT_NE(alone.find("no network interface is up"), std::string::npos) << alone;
  EXPECT_NE(alone.find("--master 127.0.0.1:4700"), std::string::npos) << alone;
  const std::string loopback = invitation(options, {"127.0.0.1", 4700}, {}).back();
  EXPECT_NE(loopback.find("on this machine"), std::string::npos) << loopback;
  EXPECT_NE(loopback.find("--listen 0.0.0.0:4700"), std::string::npos) << loopback;
}

TEST(Invitation, AnAddressFileHasWhatOthersDial) {
  const auto text = [](const Endpoint& at, const std::vector<std::string>& addresses) {
    std::string all;
    for (const Endpoint& one : reachableAt(at, addresses)) all += addressText(one) + " ";
    return all;
  };
  EXPECT_EQ(text({"10.0.0.1", 4700}, {"192.0.2.7"}), "10.0.0.1:4700 ");
  EXPECT_EQ(text({"0.0.0.0", 4700}, {"192.0.2.7", "10.1.0.2"}), "192.0.2.7:4700 10.1.0.2:4700 ");
  EXPECT_EQ(text({"::", 4700}, {"2001:db8::7"}), "[2001:db8::7]:4700 ");
  EXPECT_EQ(text({"0.0.0.0", 4700}, {}), "127.0.0.1:4700 ");
}

// Numbers only: no name that another machine may understand otherwise, and nothing that ends at its
// reader.
TEST(Invitation, AddressesAreThoseOfInterfacesAndNotLoopback) {
  for (const char* any : {"0.0.0.0", "::"})
    for (const std::string& address : addressesBehind(any)) {
      EXPECT_FALSE(isLoopback(address)) << address;
      EXPECT_FALSE(address.starts_with("fe80")) << address;
      EXPECT_EQ(address.find_first_not_of("0123456789abcdef.:"), std::string::npos) << address;
      EXPECT_TRUE(any == std::string("::") || address.find(':') == std::string::npos) << address;
    }
}

TEST(Invitation, RefusesToWaitForClientsThatCannotCome) {
  Options options;
  options.localClients = 2, options.waitClients = 3;
  EXPECT_THROW(checkGuests(options), UsageError);
  options.waitClients = 2;
  EXPECT_NO_THROW(checkGuests(options));
  options.localClients = 0, options.waitClients = 1;
  EXPECT_THROW(checkGuests(options), UsageError);
  setKeyFile(options);
  EXPECT_NO_THROW(checkGuests(options));
}

}  // namespace
}  // namespace ninefold
