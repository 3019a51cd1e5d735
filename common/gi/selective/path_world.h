// path_world.h: what photons' paths depend on in one state of a scene, kept after that state is
// gone: tells which paths of then may be others now.
//
//   rays         near what moved or shares a hierarchy with it (tracing/ray_changes.h)
//   materials    where instances have one that is different now
//   lamps        photons start otherwise; which ones, their starts tell, which cost no ray
//   everything   another order of solids that overlap, other settings that photons go by
//
// Proved:  tests/gi/kept_paths_test.cpp.
// Owner:   keeps geometry of its state alive.
// Threads: const after construction; since may be called from any thread.   Errors: none.
#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "common/gi/light/minor_lamps.h"
#include "common/gi/light/transport.h"

namespace ninefold {

// Boxes in which paths may be others.
struct PathChanges {
  bool everywhere = false;
  bool starts = false;  // some photons may start otherwise
  Bounds all = {};      // of the boxes
  std::vector<Bounds> boxes = {};

  void add(const Bounds& box) {
    all.add(box.low), all.add(box.high);
    boxes.push_back(box);
  }
  // Whether origin + t way, t in [0, 1], meets any.
  bool concern(Vec3 origin, Vec3 way) const;
};

class PathWorld {
 public:
  // minor: as in lampsStamp.
  PathWorld(const Transport& transport, const MinorLamps& minor);

  // From then to this state.
  const PathChanges& since(const std::shared_ptr<const PathWorld>& then) const;

 private:
  PathChanges changesSince(const PathWorld& then) const;

  const Settings settings_;
  const size_t streams_;
  const uint64_t lamps_;
  const std::shared_ptr<const RayAnswers> answers_;
  const std::vector<int> solidRanks_;
  std::vector<uint64_t> materials_;  // by instance: stamp of its material

  using Known = std::pair<std::shared_ptr<const PathWorld>, std::unique_ptr<const PathChanges>>;
  mutable std::mutex mutex_;
  mutable std::vector<Known> known_;  // guarded by mutex_
};

}  // namespace ninefold
