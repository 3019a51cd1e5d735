// The list of hosts, and what ssh is told to do on each. Whether it does: cluster/hosts_test.py.
#include "master/serving/host_clients.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <array>
#include <cstdio>

#include "common/base/error.h"
#include "tests/scene/temp_folder.h"

namespace ninefold {
namespace {

std::string complaint(std::string_view text) {
  try {
    parseHosts(text, "hosts");
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Hosts, AreReadLineByLine) {
  const auto hosts = parseHosts(
      "# the lab\nrender1\n\n me@render2  /opt/nf/ninefold-client # old\n"
      "ssh://me@render3:2222",
      "hosts");
  ASSERT_EQ(hosts.size(), 3u);
  EXPECT_EQ(hosts[0].name, "render1");
  EXPECT_EQ(hosts[0].program, "ninefold-client");
  EXPECT_EQ(hosts[1].name, "me@render2");
  EXPECT_EQ(hosts[1].program, "/opt/nf/ninefold-client");
  EXPECT_EQ(hosts[2].name, "ssh://me@render3:2222");
}

TEST(Hosts, ABadLineIsNamed) {
  EXPECT_NE(complaint("a\n-oProxyCommand=true\n").find("hosts:2"), std::string::npos)
      << "no option for ssh";
  EXPECT_NE(complaint("a b c\n").find("hosts:1"), std::string::npos);
  EXPECT_NE(complaint("caf\xc3\xa9\n").find("hosts:1"), std::string::npos);
  EXPECT_NE(complaint(std::string(300, 'a')).find("hosts:1"), std::string::npos);
  EXPECT_NE(complaint("# nobody\n").find("0 hosts"), std::string::npos);
  std::string many;
  for (size_t i = 0; i <= kMostHosts; ++i) many += "a\n";
  EXPECT_NE(complaint(many).find("4097 hosts"), std::string::npos);
}

TEST(Hosts, AListThatCannotBeReadIsToldWithItsCause) {
  const auto complaintOf = [](const char* file) -> std::string {
    try {
      readHosts(file);
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_NE(complaintOf("/nowhere/hosts").find("No such file"), std::string::npos);
  EXPECT_NE(complaintOf("/").find("Is a directory"), std::string::npos);
  EXPECT_NE(complaintOf("/dev/null").find("0 hosts"), std::string::npos);
}

TEST(Hosts, OneThatStandsThereTwiceGetsTwoClients) {
  EXPECT_EQ(parseHosts("render1\nrender1\n", "hosts").size(), 2u);
}

// A shell does what the host's would: prints the words that the client gets.
std::string remoteWords(const std::string& program, const Endpoint& listen,
                        const std::string& connection) {
  const TempFolder folder;
  const auto tool = folder.write(program, "#!/bin/sh\nprintf '<%s>' \"$@\"\n");
  std::filesystem::permissions(tool, std::filesystem::perms::owner_all);
  const auto plan = hostPlan({{"render1", (folder.path() / program).string()}},
                             std::make_shared<const Key>(Key::random()), listen, "avx2");
  EXPECT_EQ(plan.clients.at(0).arguments.at(0), "render1");
  const std::string command = plan.clients[0].arguments.at(1);
  ::setenv("SSH_CONNECTION", connection.c_str(), 1);
  FILE* pipe = popen(command.c_str(), "r");
  std::array<char, 1024> text{};
  const size_t size = std::fread(text.data(), 1, text.size(), pipe);
  EXPECT_EQ(pclose(pipe), 0);
  return {text.data(), size};
}

TEST(Hosts, TheClientDialsWhereSshCameFromOrWhereTheMasterListens) {
  const std::string rest = "<--name=render1><--isa=avx2><--key-descriptor=0>";
  const std::string v4 = "192.0.2.1 50000 192.0.2.9 22", v6 = "fd00::1 50000 fd00::9 22";
  EXPECT_EQ(remoteWords("client", {"0.0.0.0", 4700}, v4), "<--master=192.0.2.1:4700>" + rest);
  EXPECT_EQ(remoteWords("client", {"::", 4700}, v6), "<--master=[fd00::1]:4700>" + rest);
  EXPECT_EQ(remoteWords("client", {"10.1.0.2", 4700}, v4), "<--master=10.1.0.2:4700>" + rest);
  EXPECT_EQ(remoteWords("it's;$HOME", {"10.1.0.2", 4700}, v4), "<--master=10.1.0.2:4700>" + rest);
}

}  // namespace
}  // namespace ninefold
