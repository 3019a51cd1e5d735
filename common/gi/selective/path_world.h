// path_world.h: what photons' paths depend on in one state of a scene. It stays when that state is
// gone, and tells another state which paths may be others there.
//
//   rays         near what moved or shares a hierarchy with it (tracing/ray_changes.h)
//   materials    where instances have one that is different now
//   lamps        photons start otherwise; which ones, their starts tell, which cost no ray
//   everything   another order of solids that overlap, other settings that photons go by
//
// Proved:  tests/gi/kept_paths_test.cpp.
// Owner:   keeps geometry and hierarchies of its state alive. They must not be traced once its
//          scene is gone. Knows other states without keeping them.
// Threads: const after construction; since may be called from any thread.   Errors: none.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "common/gi/light/minor_lamps.h"
#include "common/gi/light/transport.h"

namespace ninefold {

// Boxes in which paths may be others.
struct PathChanges {
  bool everywhere = false;
  bool starts = false;  // some photons may start otherwise
  bool solids = false;  // photons ask, or asked, what lies around their lamp (media_around.h)
  Bounds all = {};      // of the boxes
  std::vector<Bounds> boxes = {};

  void add(const Bounds& box) {
    all.add(box.low), all.add(box.high);
    boxes.push_back(box);
  }
  // Whether the way from a to b meets any.
  bool concern(Vec3 a, Vec3 b) const;
};

class PathWorld {
 public:
  // minor: as in lampsStamp.
  PathWorld(const Transport& transport, const MinorLamps& minor);

  // From then to this state. What it gives lives as long as both.
  const PathChanges& since(const std::shared_ptr<const PathWorld>& then) const;
  // What is nearer than that to a changed thing counts as in it [m].
  Metres margin() const;

 private:
  PathChanges changesSince(const PathWorld& then) const;

  const Settings settings_;
  const size_t streams_;
  const uint64_t lamps_;
  const bool hasSolids_;
  const std::shared_ptr<const RayAnswers> answers_;
  const std::vector<int> solidRanks_;
  std::vector<uint64_t> materials_;  // by instance: stamp of its material

  struct Known {
    std::weak_ptr<const PathWorld> then;
    std::unique_ptr<const PathChanges> changes;
  };
  mutable std::mutex mutex_;
  mutable std::vector<Known> known_;  // guarded by mutex_
};

}  // namespace ninefold
