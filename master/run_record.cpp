#include "master/run_record.h"

namespace ninefold {
namespace {

double inMs(Duration d) { return 1000 * seconds(d); }

std::vector<ClientStats> clientStats(const Server& server, Time end) {
  std::vector<ClientStats> all;
  for (const ClientInfo& client : server.clients(end))
    if (client.work)
      all.push_back({client.name, client.isa, client.work->tasks, client.work->busyFraction(),
                     client.work->setsPerFrame()});
  return all;
}

}  // namespace

void RunRecord::frameDone(Time completed, Duration filtering) {
  completions_.push_back(completed);
  filtering_ += filtering;
}

RunStats RunRecord::stats(const Server& server, Duration decoding, int decoders) const {
  const ServerTally tally = server.tally();
  RunStats stats;
  stats.rays = tally.rays;
  stats.bytesReceived = tally.bytesReceived;
  stats.tilesStale = tally.tasks.droppedStale;
  stats.tilesDuplicate = tally.tasks.droppedDuplicate;
  stats.tilesMalformed = tally.malformed + tally.tasks.droppedUnknown;
  stats.tasksReissued = tally.tasks.reissued;
  stats.reproducible = tally.reproducible;
  if (completions_.empty() || !tally.firstDispatch) return stats;

  const Duration whole = completions_.back() - *tally.firstDispatch;
  const auto frames = static_cast<double>(completions_.size());
  stats.seconds = seconds(whole);
  Time before = *tally.firstDispatch;
  for (const Time completed : completions_) {
    stats.frameMs.push_back(inMs(completed - before));
    before = completed;
  }
  stats.clients = clientStats(server, completions_.back());
  stats.decodeMs = inMs(decoding) / frames;
  stats.filterMs = inMs(filtering_) / frames;
  stats.idleFraction = 1 - seconds(decoding + filtering_) / (seconds(whole) * (decoders + 1));
  return stats;
}

}  // namespace ninefold
