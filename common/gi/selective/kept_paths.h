// kept_paths.h: the paths that photons took when they were last traced here, row by row.
//
// Each client keeps what it traced itself. Nothing but time depends on that (path_replay.h).
//
// Memory:  12 bytes a ray, 12 a hit, 28 a photon and stream, all twice; and what moved
//          (path_world.h). Large pools are not kept (StateFacts::remembers).
// Owner:   shared by the methods of successive edits.
// Threads: any.   Errors: none.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <vector>

#include "common/gi/elements/photon_rows.h"
#include "common/gi/selective/path_world.h"

namespace ninefold {

struct KeptPath {
  uint64_t start = 0;                   // stamp of how it started
  uint32_t pointsEnd = 0, hitsEnd = 0;  // its points and hits end before these
};

// The paths of one row: photon by photon, and stream by stream of each.
struct KeptRow {
  std::shared_ptr<const PathWorld> world;  // that it was traced in
  uint32_t randomization = 0;
  std::vector<KeptPath> paths;
  std::vector<Vec3> points;      // of a path: where each ray starts, and where the last one ends
  std::vector<ElementHit> hits;  // all of them, before any is thinned
};

class KeptPaths {
 public:
  explicit KeptPaths(uint32_t rows) : rows_(rows) {}
  // Null: it is not here.
  std::shared_ptr<const KeptRow> find(uint32_t row, uint32_t randomization) const;
  // The last two randomizations of each row stay: at rest the next pool is traced while this one
  // lights a frame.
  void put(uint32_t row, std::shared_ptr<const KeptRow> kept);

 private:
  mutable std::mutex mutex_;
  std::vector<std::array<std::shared_ptr<const KeptRow>, 2>> rows_;  // guarded by mutex_
};

}  // namespace ninefold
