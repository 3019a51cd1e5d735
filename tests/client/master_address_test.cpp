// Addresses from a file: by turns, read anew each time, bounded.
#include "client/master_address.h"

#include <gtest/gtest.h>

#include "common/base/written_file.h"
#include "tests/scene/temp_folder.h"

namespace ninefold::client {
namespace {

std::string complaint(std::string_view text) {
  try {
    parseAddresses(text, "f");
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(MasterAddress, AFixedAddressIsTheSameEachTime) {
  MasterAddress address(Endpoint{"pc1", 4700});
  EXPECT_EQ(addressText(address.next()), "pc1:4700");
  EXPECT_EQ(addressText(address.next()), "pc1:4700");
}

TEST(MasterAddress, AFileIsReadBeforeEachAttemptAndItsAddressesTakeTurns) {
  const TempFolder folder;
  const auto file = folder.path() / "address";
  MasterAddress address(file);
  try {
    address.next();
    FAIL() << "there is no file yet";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("--address-file"), std::string::npos);
  }
  writeFile(file, "10.0.0.1:4700\n[fd00::1]:4700\n");
  EXPECT_EQ(addressText(address.next()), "10.0.0.1:4700");
  EXPECT_EQ(addressText(address.next()), "[fd00::1]:4700");
  EXPECT_EQ(addressText(address.next()), "10.0.0.1:4700");
  writeFile(file, "10.0.0.1:4701\n");
  EXPECT_EQ(addressText(address.next()), "10.0.0.1:4701") << "the master was started again";
}

TEST(MasterAddress, WhatIsNoListOfAddressesIsRefusedInOneLine) {
  EXPECT_NE(complaint("").find("0 addresses"), std::string::npos);
  EXPECT_NE(complaint("\n\n").find("0 addresses"), std::string::npos);
  EXPECT_NE(complaint("10.0.0.1").find("ADDR:PORT"), std::string::npos);
  EXPECT_NE(complaint("a:1\nb:65536\n").find("b:65536"), std::string::npos);
  EXPECT_NE(complaint(std::string("a:1\0", 4)), "accepted");
  EXPECT_NE(complaint(std::string(MasterAddress::kMostBytes + 1, 'x')).find("too long"),
            std::string::npos);
  std::string many;
  for (size_t i = 0; i <= MasterAddress::kMostAddresses; ++i) many += "a:1\n";
  EXPECT_NE(complaint(many).find("65 addresses"), std::string::npos);
  EXPECT_EQ(parseAddresses("a:1\nb:2", "f").size(), 2u) << "the last line may lack its end";
}

}  // namespace
}  // namespace ninefold::client
