// latency_log.h: what a person would feel of a session: for each frame that was seen, the time from
// its newest change until it was there; and the steps of the method's state. Written as
// docs/script.md describes. Plain value.
#pragma once

#include <string>
#include <vector>

#include "master/running/live_run.h"
#include "master/running/shots.h"

namespace ninefold {

class LatencyLog {
 public:
  explicit LatencyLog(Time start) : start_(start) {}
  void add(const Shown& shown);
  void add(const std::vector<Shot>& shots);
  std::string json(const std::string& scene, const ServerTally& tally) const;

 private:
  struct Entry {
    uint32_t frame, state;
    double time, latency;  // [s]; latency < 0: the frame shows no change
    double took;           // from opening to the last tile [s]
    bool moving;
    Delivery::Form form;
    int width, height;
    double light;
  };
  Time start_;
  std::vector<Entry> entries_;
  std::vector<LiveStep> steps_;
  std::vector<Shot> shots_;
};

}  // namespace ninefold
