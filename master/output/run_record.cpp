#include "master/output/run_record.h"

#include "common/base/cpu_time.h"

namespace ninefold {
namespace {

double inMs(Duration d) { return 1000 * seconds(d); }

std::vector<ClientStats> clientStats(const Server& server, Time end) {
  std::vector<ClientStats> all;
  for (const ClientInfo& client : server.clients(end))
    if (client.work)
      all.push_back({client.name, client.isa, client.work->tasks, client.work->busyFraction(),
                     client.work->setsPerFrame(), client.work->timesStuck});
  return all;
}

}  // namespace

StepStats stepStatsOf(const ServerTally& tally) {
  StepStats stats;
  stats.steps = tally.tasks.completedSteps, stats.units = tally.tasks.completedUnits;
  if (stats.steps > 0) stats.ms = inMs(tally.inSteps) / static_cast<double>(stats.steps);
  stats.bytesReceived = tally.stepBytesReceived, stats.bytesSent = tally.stepBytesSent;
  return stats;
}

void RunRecord::frameDone(const Assembly::Complete& frame, Duration cpu) {
  frames_.push_back(frame);
  cpu_ = cpu;
}

RunStats RunRecord::stats(const Server& server, const Assembly::Busy& busy, int workers) const {
  const ServerTally tally = server.tally();
  RunStats stats;
  stats.rays = tally.rays;
  stats.bytesReceived = tally.bytesReceived;
  stats.tilesStale = tally.tasks.droppedStale;
  stats.tilesDuplicate = tally.tasks.droppedDuplicate;
  stats.tilesMalformed = tally.malformed + tally.tasks.droppedUnknown;
  stats.tasksReissued = tally.tasks.reissued;
  stats.clientsStuck = tally.tasks.clientsStuck;
  stats.valuesNotFinite = tally.replaced;
  stats.steps = stepStatsOf(tally);
  stats.reproducible = tally.reproducible;
  stats.clients = clientStats(server, frames_.empty() ? Clock::now() : frames_.back().finished);
  if (frames_.empty() || !tally.firstDispatch) return stats;

  const Duration whole = frames_.back().finished - *tally.firstDispatch;
  const auto frames = static_cast<double>(frames_.size());
  stats.seconds = seconds(whole);
  Time before = *tally.firstDispatch;
  for (const Assembly::Complete& frame : frames_) {
    stats.frameMs.push_back(inMs(frame.finished - before));
    stats.latencyMs.push_back(inMs(frame.finished - frame.opened));
    stats.tailMs.push_back(inMs(frame.finished - frame.lastResult));
    before = frame.finished;
  }
  stats.decodeMs = inMs(busy.unpacking) / frames;
  stats.filterMs = inMs(busy.finishing) / frames;
  stats.idleFraction = 1 - seconds(busy.unpacking + busy.finishing) /
                               (seconds(whole) * static_cast<double>(workers));
  stats.cpuMs = inMs(cpu_ - tally.cpuAtDispatch) / frames;
  stats.memoryMb = static_cast<double>(peakMemory()) / 1e6;
  return stats;
}

}  // namespace ninefold
