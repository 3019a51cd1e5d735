#include "common/gi/selective/path_world.h"

#include <algorithm>

#include "common/gi/elements/scene_stamp.h"
#include "common/gi/light/solid_ranks.h"
#include "common/math/box_rays.h"
#include "common/scene/methods.h"
#include "common/tracing/ray_changes.h"

namespace ninefold {

bool PathChanges::concern(Vec3 origin, Vec3 way) const {
  if (everywhere) return true;
  return meetsBox(all, origin, way, 1) && std::ranges::any_of(boxes, [&](const Bounds& box) {
           return meetsBox(box, origin, way, 1);
         });
}

PathWorld::PathWorld(const Transport& t, const MinorLamps& minor)
    : settings_(t.settings),
      streams_(t.streams.count()),
      lamps_(lampsStamp(t, minor)),
      answers_(t.tracer.answers()),
      solidRanks_(solidRanks(t.scene)) {
  for (const Instance& instance : t.scene.instances) {
    const Mesh& mesh = t.scene.meshes[static_cast<size_t>(instance.mesh)];
    materials_.push_back(materialStamp(t.scene.materials[static_cast<size_t>(mesh.material)]));
  }
}

const PathChanges& PathWorld::since(const std::shared_ptr<const PathWorld>& then) const {
  const std::lock_guard lock(mutex_);
  const auto found = std::ranges::find(known_, then, &Known::first);
  if (found != known_.end()) return *found->second;
  known_.emplace_back(then, std::make_unique<const PathChanges>(changesSince(*then)));
  return *known_.back().second;
}

PathChanges PathWorld::changesSince(const PathWorld& then) const {
  if (this == &then) return {};
  const StateFacts* facts = factsOf(settings_.method).state;
  const auto moved = rayChanges(*then.answers_, *answers_);
  if (!moved || !facts->isKept(then.settings_, settings_) || then.streams_ != streams_ ||
      then.solidRanks_ != solidRanks_ || then.materials_.size() != materials_.size())
    return {.everywhere = true};
  PathChanges changes{.starts = then.lamps_ != lamps_};
  for (const Bounds& box : *moved) changes.add(box);
  for (uint32_t i = 0; i < materials_.size(); ++i)
    if (materials_[i] != then.materials_[i]) changes.add(boxOf(*answers_, i));
  return changes;
}

}  // namespace ninefold
