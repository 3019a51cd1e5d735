// run_record.h: what is noted while a run goes on, and the statistics made of it. Value.
#pragma once

#include <vector>

#include "master/assembly/assembly.h"
#include "master/output/stats.h"
#include "master/serving/server.h"

namespace ninefold {

StepStats stepStatsOf(const ServerTally& tally);

class RunRecord {
 public:
  // `cpu`: what the process has used so far.
  void frameDone(const Assembly::Complete& frame, Duration cpu);

  // The part of the statistics that the server, the workers and this record know.
  RunStats stats(const Server& server, const Assembly::Busy& busy, int workers) const;

 private:
  std::vector<Assembly::Complete> frames_;
  Duration cpu_{0};  // until the last of them
};

}  // namespace ninefold
