#include "master/serving/started_clients.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <functional>
#include <thread>

#include "proto/messages.h"

namespace ninefold {
namespace {

using std::chrono::seconds;

StartedClients::Plan shell(const std::string& script, int count) {
  StartedClients::Plan plan{
      "/bin/sh", {"-c", script}, std::make_shared<const Key>(Key::random()), {}};
  for (int i = 1; i <= count; ++i)
    plan.clients.push_back({fmt::format("local{}", i), fmt::format("local client {}", i), {}});
  return plan;
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

TEST(RestartPolicy, AHostIsAskedAgainForEverMoreAndMoreRarely) {
  RestartPolicy policy(true);
  Time now(seconds(100));
  Duration pause{0};
  for (int i = 0; i < 1000; ++i) {
    const auto next = policy.crashed(now, now);
    ASSERT_TRUE(next);
    EXPECT_GE(*next - now, pause);
    pause = *next - now;
    ASSERT_LE(pause, seconds(64));
    now = *next;
  }
  EXPECT_EQ(pause, seconds(64));
  EXPECT_EQ(*policy.crashed(now - seconds(3600), now) - now, seconds(1)) << "it lived long";
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

TEST(StartedClients, GetTheKeyByTheirDescriptor) {
  std::string file = testing::TempDir() + "ninefold-key-bytes-XXXXXX";
  ASSERT_GE(Descriptor(::mkstemp(file.data())).get(), 0);
  StartedClients clients(shell("wc -c <&3 >" + file + "; exec sleep 1000", 1));
  clients.start(Time(seconds(100)));
  int bytes = 0;
  EXPECT_TRUE(eventually([&] { return !!(std::ifstream(file) >> bytes); }));
  EXPECT_EQ(bytes, static_cast<int>(Key::kBytes));
  std::filesystem::remove(file);
}

TEST(StartedClients, GetTheKeyAsStandardInputWherePlanned) {
  std::string file = testing::TempDir() + "ninefold-key-bytes-XXXXXX";
  ASSERT_GE(Descriptor(::mkstemp(file.data())).get(), 0);
  StartedClients::Plan plan = shell("wc -c >" + file + "; exec sleep 1000", 1);
  plan.child = {.inheritedAs = 0, .ownGroup = true};
  StartedClients clients(plan);
  clients.start(Time(seconds(100)));
  int bytes = 0;
  EXPECT_TRUE(eventually([&] { return !!(std::ifstream(file) >> bytes); }));
  EXPECT_EQ(bytes, static_cast<int>(Key::kBytes));
  std::filesystem::remove(file);
}

TEST(StartedClients, AreStartedAgainAfterACrash) {
  StartedClients clients(shell("kill -9 $$", 1));
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

TEST(StartedClients, AreGivenUpWhenTheyKeepCrashing) {
  StartedClients clients(shell("exit 1", 2));
  Time now(seconds(100));
  clients.start(now);
  EXPECT_TRUE(eventually([&] {
    clients.poll(now += seconds(1));
    return clients.exhausted();
  }));
  EXPECT_GE(clients.crashes(), 6u);
}

TEST(StartedClients, OneThatHangsThreeTimesIsGivenUpAndItsTaskIsNamed) {
  std::string asked;
  StartedClients clients(shell(fmt::format("exit {}", kHungStatus), 1),
                         [&](const std::string& name) -> StartedClients::Work {
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

TEST(StartedClients, OneThatHangsAgainAndAgainBetweenResultsIsStartedAgain) {
  StartedClients clients(shell(fmt::format("exit {}", kHungStatus), 1),
                         [](const std::string&) -> StartedClients::Work {
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

TEST(StartedClients, GoWhenAskedAndAreKilledWhenTheyDoNot) {
  const Time now(seconds(100));
  StartedClients polite(shell("exec sleep 1000", 1));
  polite.start(now);
  polite.stop(now);
  EXPECT_TRUE(eventually([&] {
    polite.poll(now);
    return polite.running() == 0;
  }));

  StartedClients stubborn(shell("trap '' TERM; while :; do sleep 1; done", 1));
  stubborn.start(now);
  std::this_thread::sleep_for(milliseconds(100));  // let it set its trap
  stubborn.stop(now);
  stubborn.poll(now + seconds(1));
  EXPECT_EQ(stubborn.running(), 0);
}

}  // namespace
}  // namespace ninefold
