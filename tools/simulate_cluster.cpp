// ninefold-simulate-cluster [options]: the master's scheduler with simulated clients under a
// simulated clock: how well any number of them is used, without having them.
//
// Mixed clients have 1 to 8 threads, speeds from 1/4 to 4 and one-way latencies from 0.05 to 1.6
// ms. With --fail-every S one client dies every S seconds, every other time silently (its line is
// cut, so that only the missing heartbeat tells), and comes back as a new client 5 s later. With
// --straggle-every S one client stands still for 2 s every S seconds. Which ones follows from the
// seed: equal options give equal results. Writes one JSON object.
// Exit status: 0 done, 1 frames were not completed, 2 wrong usage.

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "common/scene/settings_table.h"
#include "tools/command.h"
#include "tools/simulated_cluster.h"

namespace ninefold {
namespace {

namespace po = boost::program_options;

struct Options {
  int clients = 16, frames = 100, framesInFlight = 16;
  uint32_t seed = 1;
  std::string size = "640x480";
  double taskMs = 4, setMs = 0.5, failEvery = 0, straggleEvery = 0;
  bool mixed = false;
};

constexpr double kComesBack = 5, kStandsStill = 2;  // [s]

double speedOf(const std::vector<SimulatedClient>& clients) {
  double sum = 0;
  for (const SimulatedClient& c : clients) sum += c.speed * c.threads;
  return sum;
}

// Calls event(client, when) for one client every `every` seconds, none of them twice.
template <typename Event>
void scatter(std::vector<SimulatedClient>& clients, double every, double until,
             std::mt19937& random, const Event& event) {
  if (every <= 0) return;
  std::vector<size_t> order(clients.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::shuffle(order, random);
  for (size_t i = 0; i < order.size(); ++i) {
    const double when = every * static_cast<double>(i + 1);
    if (when > until) return;
    event(order[i], when);
  }
}

std::vector<SimulatedClient> makeClients(const Options& o, double workOfFrame) {
  std::vector<SimulatedClient> clients;
  for (int i = 0; i < o.clients; ++i)
    clients.push_back(o.mixed ? SimulatedClient{.threads = 1 + i * 5 % 8,
                                                .speed = 0.25 * (1 << i * 3 % 5),
                                                .latency = 5e-5 * (1 << i * 2 % 6)}
                              : SimulatedClient{});
  std::mt19937 random(o.seed);
  const double until = 2 * workOfFrame * o.frames / speedOf(clients);
  std::vector<SimulatedClient> back;
  bool silently = false;
  scatter(clients, o.failEvery, until, random, [&](size_t i, double when) {
    (silently ? clients[i].cut : clients[i].dies) = when;
    silently = !silently;
    SimulatedClient again = clients[i];
    again.dies = again.cut = kNever, again.joins = when + kComesBack;
    back.push_back(again);
  });
  scatter(clients, o.straggleEvery, until, random, [&](size_t i, double when) {
    clients[i].freezes = when, clients[i].thaws = when + kStandsStill;
  });
  clients.insert(clients.end(), back.begin(), back.end());
  return clients;
}

double percentile(std::vector<double> values, double p) {
  std::ranges::sort(values);
  const auto rank = static_cast<size_t>(std::ceil(p * static_cast<double>(values.size())));
  return values[std::max<size_t>(rank, 1) - 1];
}

nlohmann::ordered_json report(const Options& o, const SimulatedCluster& cluster) {
  const SchedulerCounts& n = cluster.scheduler().counts();
  double sets = 0, working = 0;
  for (const ClientReport& r : cluster.reports())
    if (r.frames > 0) sets += r.setsPerFrame(), ++working;
  return {{"clients", o.clients},
          {"frames", cluster.completed()},
          {"seconds", cluster.elapsed()},
          {"fps", cluster.completed() / cluster.elapsed()},
          {"efficiency", cluster.efficiency()},
          {"latency_ms",
           {{"p50", 1e3 * percentile(cluster.latencies(), 0.5)},
            {"p95", 1e3 * percentile(cluster.latencies(), 0.95)}}},
          {"sets_per_frame", sets / working},
          {"tasks", n.accepted},
          {"duplicated", n.duplicated},
          {"reissued", n.reissued}};
}

int run(int argc, char** argv) {
  Options o;
  Command command{"ninefold-simulate-cluster", "[options]",
                  "The master's scheduler with simulated clients: how well any number is used.\n"};
  command.flags.add_options()("clients", po::value(&o.clients), "1 to 10000, default 16")(
      "mixed", po::bool_switch(&o.mixed), "of mixed speed; default: all alike, one thread")(
      "frames", po::value(&o.frames), "to complete, default 100")(
      "frames-in-flight", po::value(&o.framesInFlight),
      "open at once at most, default 16 as the master")("size", po::value(&o.size),
                                                        "WxH, default 640x480")(
      "task-ms", po::value(&o.taskMs), "work of a full task for a thread of speed 1, default 4")(
      "set-ms", po::value(&o.setMs), "work of a light set, default 0.5")(
      "fail-every", po::value(&o.failEvery), "seconds; default 0: never")(
      "straggle-every", po::value(&o.straggleEvery), "seconds; default 0: never")(
      "seed", po::value(&o.seed), "default 1");
  if (!parseCommandLine(argc, argv, command)) return 0;
  checkRange("clients", o.clients, 1, 10'000);
  checkRange("frames", o.frames, 1, 1'000'000);
  checkRange("frames-in-flight", o.framesInFlight, 1, 1000);
  const auto [width, height] = parseSize(o.size);
  SimulatedJob job;
  job.grid = TileGrid(width, height, {3, 3});
  job.frames = o.frames, job.framesInFlight = o.framesInFlight;
  job.taskSeconds = 1e-3 * o.taskMs, job.setSeconds = 1e-3 * o.setMs;
  job.checkEvery = 100'000;
  SimulatedCluster cluster(job, makeClients(o, job.grid.tasks() * job.taskSeconds));
  cluster.run(1e6);
  if (!cluster.finished()) fail("only {} frames completed", cluster.completed());
  writeOutput(report(o, cluster).dump(2) + "\n");
  return 0;
}

}  // namespace
}  // namespace ninefold

int main(int argc, char** argv) {
  return ninefold::runProgram("ninefold-simulate-cluster",
                              [&] { return ninefold::run(argc, argv); });
}
