// The scheduler around a simulated cluster: every frame completes, whatever happens to the clients,
// and threads do useful work for at least the stated share of the time. Also what 1000 clients
// cost.
#include "tools/simulated_cluster.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/seeds.h"

namespace ninefold {
namespace {

using Clients = std::vector<SimulatedClient>;

Clients alike(int count, SimulatedClient model = {}) {
  return Clients(static_cast<size_t>(count), model);
}

// Speeds from 1/4 to 4, threads from 1 to 8, latencies from 0.05 to 1.6 ms, in a fixed mixture.
Clients mixed(int count) {
  Clients clients;
  for (int i = 0; i < count; ++i)
    clients.push_back({.threads = 1 + i * 5 % 8,
                       .speed = 0.25 * (1 << i * 3 % 5),
                       .latency = 5e-5 * (1 << i * 2 % 6)});
  return clients;
}

SimulatedCluster play(const SimulatedJob& job, const Clients& clients, double deadline = 1000) {
  SimulatedCluster cluster(job, clients);
  cluster.run(deadline);
  EXPECT_TRUE(cluster.finished()) << cluster.completed() << " of " << job.frames << " frames";
  EXPECT_TRUE(cluster.everyTaskOnce());
  return cluster;
}

double meanSetsPerFrame(const SimulatedCluster& cluster) {
  double sum = 0;
  for (const ClientReport& r : cluster.reports()) sum += r.setsPerFrame();
  return sum / static_cast<double>(cluster.reports().size());
}

TEST(SimulatedCluster, EqualClientsWorkWithoutPause) {
  for (const int count : {1, 2, 5, 16, 64}) {
    SCOPED_TRACE(count);
    EXPECT_GE(play({.frames = 10}, alike(count)).efficiency(), 0.98);
  }
}

TEST(SimulatedCluster, ClientsMakeFewLightSets) {
  // Fewest possible: 9 sets over n clients. The paper: about two for each client and frame.
  for (const auto& [count, most] : {std::pair(2, 5.0), {5, 3.2}, {16, 2.0}, {64, 1.3}}) {
    SCOPED_TRACE(count);
    EXPECT_LE(meanSetsPerFrame(play({.frames = 10}, alike(count))), most);
  }
}

// A set of table_room at 640x480 takes four milliseconds, a task of it 1.4.
SimulatedJob tableRoom(int frames) {
  return {.frames = frames, .taskSeconds = 1.4e-3, .setSeconds = 4e-3, .checkEvery = 1000};
}

TEST(SimulatedCluster, AtRestEachLightSetIsMadeOnce) {
  constexpr int kFrames = 100;
  const double alone = play(tableRoom(kFrames), alike(1)).elapsed();
  for (const auto& [count, least] : {std::pair(2, 0.98), {16, 0.95}, {64, 0.9}}) {
    SCOPED_TRACE(count);
    const SimulatedCluster cluster = play(tableRoom(kFrames), alike(count));
    uint64_t sets = 0;
    for (const ClientReport& report : cluster.reports()) sets += report.lightSets;
    // Those of frames that were open when the last one was complete are made, too.
    EXPECT_LE(sets, 1.25 * 9 * kFrames);
    EXPECT_GE(alone / cluster.elapsed(), least * count);
  }
}

TEST(SimulatedCluster, UrgentFramesAreSharedAtOnce) {
  SimulatedJob moving = tableRoom(50);
  moving.moving = true, moving.framesInFlight = 2;
  const auto longest = [](const SimulatedCluster& cluster) {
    return *std::ranges::max_element(cluster.latencies());
  };
  const double alone = longest(play(moving, alike(1))), most = alone / 12;
  EXPECT_LE(longest(play(moving, alike(18))), most);
  SimulatedJob atRest = tableRoom(50);
  atRest.framesInFlight = 2;
  EXPECT_GT(longest(play(atRest, alike(18))), most);
}

TEST(SimulatedCluster, MixedClientsShareBySpeed) {
  SimulatedJob job{.grid = TileGrid(1280, 960, {3, 3}), .frames = 30, .checkEvery = 1000};
  for (const auto& [count, least] : {std::pair(2, 0.99), {8, 0.97}, {32, 0.95}, {64, 0.8}}) {
    SCOPED_TRACE(count);
    const SimulatedCluster cluster = play(job, mixed(count));
    EXPECT_GE(cluster.efficiency(), least);
  }
}

TEST(SimulatedCluster, LatencyIsHidden) {
  for (const auto& [latency, least] : {std::pair(1e-4, 0.99), {1e-3, 0.99}, {1e-2, 0.98}}) {
    SCOPED_TRACE(latency);
    EXPECT_GE(play({.frames = 40}, alike(4, {.latency = latency})).efficiency(), least);
  }
}

TEST(SimulatedCluster, CreditStaysSmall) {
  const SimulatedJob moving{.frames = 5, .moving = true, .checkEvery = 1};
  EXPECT_LE(play(moving, alike(8)).mostInFlight(), 3);
  // Tasks of four milliseconds, now and then less: two on their way or waiting, groups of two.
  EXPECT_LE(play({.frames = 5, .checkEvery = 1}, alike(8)).mostInFlight(), 5);
}

TEST(SimulatedCluster, ADeadClientCostsItsShareOnly) {
  Clients clients = alike(8);
  clients[3].dies = 0.5;
  const SimulatedCluster cluster = play({.frames = 10}, clients);
  EXPECT_GE(cluster.scheduler().counts().reissued, 1u);
  // Had all eight lived on, 1 / 8 of the speed more from 0.5 s on.
  const double whole = play({.frames = 10}, alike(8)).elapsed();
  EXPECT_LE(cluster.elapsed(), 1.03 * (0.5 + (whole - 0.5) * 8 / 7));
}

TEST(SimulatedCluster, WhoErrsIsFoundAndNobodyElse) {
  Clients clients = alike(8);
  clients[5].errs = 0.2;
  const SimulatedCluster cluster = play({.frames = 20, .verify = 0.05}, clients);
  ASSERT_FALSE(cluster.wrong().empty());
  for (const WrongNote& note : cluster.wrong()) EXPECT_EQ(note.client, 6u);
  EXPECT_TRUE(cluster.reports()[5].lost);
}

// A fraction P of all tasks is done twice: the rest of the time, 1 / (1 + P), is for frames.
TEST(SimulatedCluster, ChecksCostTheirShareOnly) {
  constexpr double kFraction = 0.2;
  const SimulatedCluster cluster = play({.frames = 20, .verify = kFraction}, alike(8));
  EXPECT_GE(cluster.efficiency(), 0.95 / (1 + kFraction));
  EXPECT_GT(cluster.scheduler().verificationCounts().checked, 0u);
  EXPECT_TRUE(cluster.wrong().empty());
}

TEST(SimulatedCluster, ChecksOfDeadFrozenAndStuckClientsGoToOthers) {
  Clients clients = alike(8);
  clients[1].cut = 0.3, clients[2].dies = 0.4, clients[3].freezes = 0.4;
  clients[4].errs = 0.5, clients[6].joins = 0.6;
  const SimulatedCluster cluster = play({.frames = 40, .verify = 0.3}, clients);
  for (const WrongNote& note : cluster.wrong()) EXPECT_EQ(note.client, 5u);
  EXPECT_EQ(cluster.scheduler().verificationCounts().disputed, 0u);
}

TEST(SimulatedCluster, ACutLineAndAFrozenClientDoNotStopTheFrames) {
  Clients clients = alike(6);
  clients[1].cut = 0.3;
  clients[2].freezes = 0.4;
  clients[4].freezes = 0.5, clients[4].thaws = 2.5;
  const SimulatedCluster cluster = play({.frames = 40}, clients);
  // No more than the lost speed and one wait for the silence limit.
  const double whole = play({.frames = 40}, alike(6)).elapsed();
  EXPECT_LE(cluster.elapsed(), 6.0 / 3 * whole + 1.5);
  EXPECT_GT(cluster.scheduler().counts().reissued, 0u);
  EXPECT_FALSE(cluster.reports()[4].suspect) << "it thawed and works again";
  EXPECT_GT(cluster.reports()[4].tasks, cluster.reports()[2].tasks);
}

TEST(SimulatedCluster, TheFirstFrameAroundAFrozenClientWaitsOnlyForCopies) {
  // With no further frame to open, idle clients copy the frozen client's tasks when they are late.
  Clients clients = alike(4);
  clients[0].freezes = 0.1;
  const SimulatedCluster cluster = play({.frames = 1, .framesInFlight = 1}, clients);
  EXPECT_LE(cluster.elapsed(), 1.2 * (315 * 4e-3 / 3));
}

TEST(SimulatedCluster, StuckClientsAreToldOfAndTheOthersDoTheirWork) {
  Clients clients = alike(6);
  clients[1].sticks = 0.3;
  clients[4].sticks = 0.5, clients[4].comesBack = 20;
  const SimulatedCluster cluster = play({.frames = 150}, clients);
  std::map<ClientId, int> stuck, back;
  for (const StuckNote& note : cluster.notes()) ++(note.isBack ? back : stuck)[note.client];
  EXPECT_EQ(stuck, (std::map<ClientId, int>{{2, 1}, {5, 1}}));
  EXPECT_EQ(back, (std::map<ClientId, int>{{5, 1}}));
  EXPECT_EQ(cluster.scheduler().counts().clientsStuck, 2u);
  EXPECT_GT(cluster.reports()[4].tasks, 2 * cluster.reports()[1].tasks) << "it works again";
}

TEST(SimulatedCluster, LongTasksStickNobody) {
  // Tasks of the reference may take seconds, and some machines are four times slower.
  Clients clients = alike(4);
  clients[3].speed = 0.25;
  const SimulatedCluster cluster =
      play({.grid = TileGrid(640, 480, {1, 1}), .frames = 2, .taskSeconds = 2.5, .rays = 6e3},
           clients, 1e5);
  EXPECT_TRUE(cluster.notes().empty());
}

TEST(SimulatedCluster, LateJoinersAreUsed) {
  Clients clients = alike(2);
  for (int i = 0; i < 6; ++i) clients.push_back({.joins = 1.0 + 0.1 * i});
  const SimulatedCluster cluster = play({.frames = 20}, clients);
  for (const ClientReport& r : cluster.reports()) EXPECT_GE(r.busyFraction(), 0.95) << r.client;
}

TEST(SimulatedCluster, ViewChangesCancelAndTheNewestFramesStillComplete) {
  const SimulatedCluster cluster =
      play({.frames = 20, .moving = true, .viewChangeEvery = 0.2}, alike(16));
  const SchedulerCounts& n = cluster.scheduler().counts();
  EXPECT_GT(n.cancelledFrames, 0u);
  EXPECT_GT(n.droppedStale, 0u);
  EXPECT_LE(n.droppedStale, n.cancelledTasks);
}

TEST(SimulatedCluster, SurvivesRandomFailures) {
  for (const uint64_t seed : seedsFrom(1, 4)) {
    const Repeatable repeatable(seed);
    std::mt19937 random(static_cast<uint32_t>(seed));
    const auto uniform = [&](double a, double b) {
      return std::uniform_real_distribution<double>(a, b)(random);
    };
    Clients clients = mixed(10);
    for (SimulatedClient& c : clients) {
      c.joins = uniform(0, 0.5);
      const double kind = uniform(0, 5), when = c.joins + uniform(0, 1);
      if (kind < 1)
        c.dies = when;
      else if (kind < 2)
        c.cut = when;
      else if (kind < 3)
        c.freezes = when, c.thaws = when + uniform(0, 3);
      else if (kind < 4)
        c.sticks = when, c.comesBack = when + uniform(0, 30);
    }
    clients.push_back({});  // one that lives
    play({.frames = 30, .checkEvery = 10}, clients);
  }
}

TEST(SimulatedCluster, AThousandClientsShareFiveThousandTasks) {
  SimulatedJob job{.grid = TileGrid(2560, 1920, {3, 3}), .frames = 3, .checkEvery = 1000};
  EXPECT_GE(play(job, alike(1000)).efficiency(), 0.85);
}

}  // namespace
}  // namespace ninefold
