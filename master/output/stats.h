// stats.h: what --stats writes: one JSON object about a run. The names of its keys are part of the
// outside interface; each field says which it becomes.
//
// Threads: plain value. Errors: writeStats throws Error that names the file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/base/counters.h"
#include "common/image/surface_test.h"
#include "common/scene/needs.h"
#include "common/scene/settings.h"
#include "master/scheduling/scheduler_types.h"

namespace ninefold {

struct ClientStats {
  std::string name = {}, isa = {};
  uint64_t tasks = 0;       // accepted results
  double busyFraction = 0;  // of its threads' time while it was there
  double setsPerFrame = 0;  // light sets, for each frame that it worked on
  uint64_t stuck = 0;       // times that a task of it was past its deadline
};

// Steps of a method's state.
struct StepStats {
  uint64_t steps = 0, units = 0;              // complete
  double ms = 0;                              // of a step, from its first dispatch to its end: mean
  uint64_t bytesReceived = 0, bytesSent = 0;  // page deltas
};

// Results that a second client did again.
struct VerifyStats {
  VerificationCounts counts;  // checked, wrong, alone, disputed
  uint64_t expelled = 0;      // clients
  int64_t framesAgain = 0;    // done anew because of them
};

struct RunStats {
  int64_t frames = 0;             // complete, at full size
  int64_t framesBefore = 0;       // of them out of the checkpoint; rates and sums are of the others
  double seconds = 0;             // first dispatch to last completion; gives fps and all rates
  std::vector<double> frameMs;    // from one completion to the next, in order; gives frame_ms
  std::vector<double> latencyMs;  // of each from its opening to its completion; gives latency_ms
  RayCounts rays;                 // of accepted results
  uint64_t bytesReceived = 0;
  std::vector<ClientStats> clients;
  double decodeMs = 0, filterMs = 0;  // master.decode_ms, filter_ms: mean for each frame
  double idleFraction = 0;            // master.idle_fraction: of its workers' time
  double cpuMs = 0;                   // master.cpu_ms: of the whole process, mean for each frame
  std::vector<double> tailMs;         // last result in to frame finished; gives master.tail_ms
  double memoryMb = 0;                // master.memory_mb: most that was resident
  uint64_t tilesStale = 0, tilesDuplicate = 0;
  uint64_t tilesMalformed = 0;  // not to be decoded, or never asked for
  uint64_t tasksReissued = 0;
  uint64_t clientsStuck = 0;     // that were stuck at least once
  uint64_t stalls = 0;           // times that all clients were stuck at once
  uint64_t valuesNotFinite = 0;  // or negative, where there is no light below 0: they became 0
  StepStats steps;
  std::optional<VerifyStats> verify;  // with --verify
  double relativeError = 0;           // not finite (less than two frames): null
  Needs needs;
  std::string preset;                              // settings.preset
  Settings settings;                               // method, settings, seed
  SurfaceTest surfaceTest = SurfaceTest::surface;  // settings.filter
  bool denoise = false;                            // settings.denoise: what was written had it
  bool reproducible = true;
  std::string imageHash;
};

// The object as text, keys in the order of the interface.
std::string toJson(const RunStats& stats);

// --stats of that name is standard output.
inline constexpr const char* kStandardOutput = "-";
// A file is whole or as it was before (written_file.h).
void writeStats(const std::string& path, const std::string& json);

}  // namespace ninefold
