#include "client/options.h"

#include <gtest/gtest.h>

#include <map>

namespace ninefold::client {
namespace {

using Variables = std::map<std::string, std::string>;

Options parse(std::vector<const char*> arguments, const Variables& variables = {}) {
  arguments.insert(arguments.begin(), "ninefold-client");
  const Variable lookUp = [&](const std::string& name) {
    const auto found = variables.find(name);
    return found == variables.end() ? std::nullopt : std::optional(found->second);
  };
  return parseOptions(static_cast<int>(arguments.size()), arguments.data(), lookUp, 6);
}

std::string complaint(const std::vector<const char*>& arguments) {
  try {
    parse(arguments);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ClientOptions, NeedsAnAddressAndAKeyAndGuessesTheRest) {
  const Options o = parse({"--master", "pc1:4700", "--key-file", "cluster.key"});
  EXPECT_EQ(o.master, "pc1:4700");
  EXPECT_EQ(o.keyFile, "cluster.key");
  EXPECT_EQ(o.threads, 6);
  EXPECT_EQ(o.isa, Isa::automatic);
  EXPECT_FALSE(o.name.empty());
  EXPECT_FALSE(o.local());
}

TEST(ClientOptions, FlagsWinOverVariables) {
  const Variables variables{{"NINEFOLD_MASTER", "pc1:1"},
                            {"NINEFOLD_KEY_FILE", "k"},
                            {"NINEFOLD_THREADS", "2"},
                            {"NINEFOLD_CACHE", "none"}};
  const Options o = parse({"--threads=3"}, variables);
  EXPECT_EQ(o.master, "pc1:1");
  EXPECT_EQ(o.threads, 3);
  EXPECT_EQ(o.cache, std::nullopt);
}

TEST(ClientOptions, AMastersOwnClientsAreDeafToTheEnvironment) {
  const Variables variables{{"NINEFOLD_KEY_FILE", "k"}, {"NINEFOLD_THREADS", "2"}};
  const Options o =
      parse({"--master=127.0.0.1:9", "--key-descriptor=3", "--name=local1"}, variables);
  EXPECT_TRUE(o.local());
  EXPECT_EQ(o.keyDescriptor, 3);
  EXPECT_EQ(o.keyFile, std::nullopt);
  EXPECT_EQ(o.threads, 6);
  EXPECT_EQ(o.name, "local1");
}

TEST(ClientOptions, ComplaintsNameTheFlag) {
  EXPECT_EQ(complaint({"--key-file", "k"}), "accepted") << "it looks for a master";
  EXPECT_NE(complaint({"--master", "pc1:4700"}).find("--key-file"), std::string::npos);
  const std::vector<const char*> whole{"--master", "pc1:4700", "--key-file", "k"};
  const auto with = [&](const char* flag) {
    auto arguments = whole;
    arguments.push_back(flag);
    return complaint(arguments);
  };
  EXPECT_NE(with("--threads=0").find("--threads"), std::string::npos);
  EXPECT_NE(with("--threads=many").find("--threads"), std::string::npos);
  EXPECT_NE(with("--isa=mmx").find("--isa"), std::string::npos);
  EXPECT_NE(with("--colour=red").find("colour"), std::string::npos);
  EXPECT_NE(complaint({"pc1:4700"}), "accepted");
  EXPECT_NE(complaint({"--master", "foo", "--key-file", "k"}).find("--master foo: write ADDR:PORT"),
            std::string::npos);
}

TEST(ClientOptions, TheAddressMayComeInAFile) {
  const Options o = parse({"--master-file", "job/address", "--key-file", "k"});
  EXPECT_EQ(o.masterFile, "job/address");
  EXPECT_TRUE(o.master.empty());
  EXPECT_NE(complaint({"--master-file", "f", "--master", "pc1:1", "--key-file", "k"})
                .find("exclude each other"),
            std::string::npos);
}

TEST(ClientOptions, HelpNamesEveryPublicFlagAndNoInternalOne) {
  EXPECT_TRUE(parse({"--help"}).help);
  EXPECT_TRUE(parse({"-h"}).help);
  EXPECT_TRUE(parse({"--version"}).version);
  const std::string help = helpText();
  for (const char* flag : {"--master", "--key-file", "--threads", "--cache", "--isa", "--help",
                           "--version", "Exit status: 0"})
    EXPECT_NE(help.find(flag), std::string::npos) << flag;
  EXPECT_EQ(help.find("--key-descriptor"), std::string::npos);
}

}  // namespace
}  // namespace ninefold::client
