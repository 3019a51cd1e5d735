// metrics.h: what a run does, in the text format of Prometheus (version 0.0.4). Pure.
// Threads: pure function.   Errors: none.   Proved: tests/web/web_texts_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "master/serving/server.h"

namespace ninefold {

struct RunMetrics {
  ServerTally tally;
  std::vector<ClientInfo> clients;
  int64_t framesInPicture = 0;
  double relativeError = 0;  // not finite: not known
  uint64_t viewers = 0, viewersRefused = 0, bytesToViewers = 0;
};

std::string metricsText(const RunMetrics& run);

}  // namespace ninefold
