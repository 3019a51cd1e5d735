// path_replay.h: goes through the paths of a row once more. A path that starts as it did, and met
// nothing that has changed since, is taken over with the hits that it left. All others are traced,
// and kept for the next time.
//
// What it gives is what tracing all of them would give, to the last bit: rays that meet no changed
// box have the answers that they had (path_world.h), and all else on a path follows from those.
//
// Proved:  tests/gi/kept_paths_test.cpp.
// Threads: one a row.   Errors: none.
#pragma once

#include <memory>
#include <vector>

#include "common/gi/elements/photon_shooting.h"
#include "common/gi/selective/kept_paths.h"

namespace ninefold {

class PathReplay {
 public:
  // `kept`: of the same row and randomization, or null.
  PathReplay(std::shared_ptr<const KeptRow> kept, std::shared_ptr<const PathWorld> world,
             uint32_t randomization);

  // True: the next path is taken over, and its hits are added to `hits`. start(): how it starts.
  template <typename Start>
  bool takeOver(const Start& start, std::vector<ElementHit>& hits) {
    if (changes_ == nullptr || changes_->everywhere || next_ == kept_->paths.size()) return false;
    const KeptPath& path = kept_->paths[next_];
    return passOver(!changes_->starts || path.start == stampOf(start()), hits);
  }
  // Else it starts, its rays are traced by this, and it ends, with all hits so far.
  void begin(const PhotonStart& start) { start_ = stampOf(start), hasRay_ = false; }
  Hit trace(const Tracer& tracer, Vec3 origin, Vec3 direction);
  void end(const std::vector<ElementHit>& hits) { close(start_, hits); }

  // All paths, with all hits.
  std::shared_ptr<const KeptRow> finish(const std::vector<ElementHit>& hits);

 private:
  static uint64_t stampOf(const PhotonStart& start);
  bool passOver(bool startsAlike, std::vector<ElementHit>& hits);
  bool isAsBefore(const KeptPath& path) const;
  void close(uint64_t start, const std::vector<ElementHit>& hits);

  const std::shared_ptr<const KeptRow> kept_;
  const PathChanges* changes_ = nullptr;    // since kept_; null without
  size_t next_ = 0;                         // of kept_'s paths
  uint32_t firstPoint_ = 0, firstHit_ = 0;  // of that path
  std::shared_ptr<KeptRow> now_;
  uint64_t start_ = 0;   // of the path whose turn it is
  bool hasRay_ = false;  // it was traced, and now_ has points of it
};

}  // namespace ninefold
