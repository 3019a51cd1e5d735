// run_record.h: what is noted while a run goes on, and the statistics made of it. Value.
#pragma once

#include <vector>

#include "master/server.h"
#include "master/stats.h"

namespace ninefold {

class RunRecord {
 public:
  // A frame was complete at `completed`, and took `filtering` to get onto the film.
  void frameDone(Time completed, Duration filtering);

  // The part of the statistics that the server and this record know. `decoding`: time of all
  // decoders.
  RunStats stats(const Server& server, Duration decoding, int decoders) const;

 private:
  std::vector<Time> completions_;
  Duration filtering_{0};
};

}  // namespace ninefold
