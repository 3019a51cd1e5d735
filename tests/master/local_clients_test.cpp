#include "master/serving/local_clients.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <functional>
#include <thread>

#include "proto/messages.h"

namespace ninefold {
namespace {

using std::chrono::seconds;

LocalClients::Plan shell(const std::string& script, int count) {
  return {"/bin/sh", {"-c", script}, std::make_shared<const Key>(Key::random()), count};
}

// Real processes, a told time: the deadline of a condition is only there to end a broken test.
bool eventually(const std::function<bool()>& condition) {
  for (int i = 0; i < 5000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(milliseconds(2));
  }
  return false;
}

TEST(RestartPolicy, PausesGrowAndOneThatKeepsDyingIsGivenUp) {
  RestartPolicy policy;
  Time now(seconds(100));
  Duration pause{0};
  int restarts = 0;
  for (auto next = policy.crashed(now, now); next; next = policy.crashed(now, now), ++restarts) {
    EXPECT_GT(*next - now, pause);
    pause = *next - now;
    now = *next;
    ASSERT_LT(restarts, 20);
  }
  EXPECT_GE(restarts, 3);
}

TEST(RestartPolicy, ALongLifeForgivesEarlierCrashes) {
  RestartPolicy policy;
  Time now(seconds(100));
  for (int i = 0; i < 50; ++i) {
    const auto next = policy.crashed(now, now + seconds(60));
    ASSERT_TRUE(next);
    now = *next;
  }
}

TEST(RestartPolicy, ThreeHangsInARowAreEnoughUnlessAResultCameBetween) {
  RestartPolicy policy;
  const Time now(seconds(100));
  for (const bool gaveResults : {false, false, true, false}) {
    const auto next = policy.hung(gaveResults, now);
    ASSERT_TRUE(next);
    EXPECT_GT(*next, now);
  }
  EXPECT_FALSE(policy.hung(false, now));
}

TEST(LocalClients, GetTheKeyByTheirDescriptor) {
  std::string file = testing::TempDir() + "ninefold-key-bytes-XXXXXX";
  ASSERT_GE(Descriptor(::mkstemp(file.data())).get(), 0);
  LocalClients clients(shell("wc -c <&3 >" + file + "; exec sleep 1000", 1));
  clients.start(Time(seconds(100)));
  int bytes = 0;
  EXPECT_TRUE(eventually([&] { return !!(std::ifstream(file) >> bytes); }));
  EXPECT_EQ(bytes, static_cast<int>(Key::kBytes));
  std::filesystem::remove(file);
}

TEST(LocalClients, AreStartedAgainAfterACrash) {
  LocalClients clients(shell("kill -9 $$", 1));
  Time now(seconds(100));
  clients.start(now);
  EXPECT_TRUE(eventually([&] {
    clients.poll(now);
    return clients.crashes() == 1;
  }));
  EXPECT_EQ(clients.running(), 0);
  EXPECT_FALSE(clients.exhausted());
  clients.poll(now += seconds(2));
  EXPECT_EQ(clients.running(), 1);
}

TEST(LocalClients, AreGivenUpWhenTheyKeepCrashing) {
  LocalClients clients(shell("exit 1", 2));
  Time now(seconds(100));
  clients.start(now);
  EXPECT_TRUE(eventually([&] {
    clients.poll(now += seconds(1));
    return clients.exhausted();
  }));
  EXPECT_GE(clients.crashes(), 6u);
}

TEST(LocalClients, OneThatHangsThreeTimesIsGivenUpAndItsTaskIsNamed) {
  std::string asked;
  LocalClients clients(shell(fmt::format("exit {}", kHungStatus), 1),
                       [&](const std::string& name) -> LocalClients::Work {
                         asked = name;
                         return {0, "frame 3, tile 5, set 2"};
                       });
  Time now(seconds(100));
  clients.start(now);
  EXPECT_TRUE(clients.isStarting(now));
  EXPECT_TRUE(eventually([&] {
    clients.poll(now += seconds(60));
    return clients.exhausted();
  }));
  EXPECT_EQ(clients.crashes(), 3u);
  EXPECT_EQ(asked, "local1");
  ASSERT_TRUE(clients.hang());
  EXPECT_NE(clients.hang()->find("frame 3, tile 5, set 2"), std::string::npos) << *clients.hang();
  EXPECT_FALSE(clients.isStarting(now));
}

TEST(LocalClients, OneThatHangsAgainAndAgainBetweenResultsIsStartedAgain) {
  LocalClients clients(shell(fmt::format("exit {}", kHungStatus), 1),
                       [](const std::string&) -> LocalClients::Work {
                         return {1, "frame 3, tile 5, set 2"};
                       });
  Time now(seconds(100));
  clients.start(now);
  EXPECT_TRUE(eventually([&] {
    clients.poll(now += seconds(60));
    return clients.crashes() == 10;
  }));
  EXPECT_FALSE(clients.exhausted());
  EXPECT_FALSE(clients.hang());
}

TEST(LocalClients, GoWhenAskedAndAreKilledWhenTheyDoNot) {
  const Time now(seconds(100));
  LocalClients polite(shell("exec sleep 1000", 1));
  polite.start(now);
  polite.stop(now);
  EXPECT_TRUE(eventually([&] {
    polite.poll(now);
    return polite.running() == 0;
  }));

  LocalClients stubborn(shell("trap '' TERM; while :; do sleep 1; done", 1));
  stubborn.start(now);
  std::this_thread::sleep_for(milliseconds(100));  // let it set its trap
  stubborn.stop(now);
  stubborn.poll(now + seconds(1));
  EXPECT_EQ(stubborn.running(), 0);
}

}  // namespace
}  // namespace ninefold
