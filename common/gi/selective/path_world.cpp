#include "common/gi/selective/path_world.h"

#include <algorithm>

#include "common/gi/elements/scene_stamp.h"
#include "common/gi/light/solid_ranks.h"
#include "common/math/box_rays.h"
#include "common/scene/methods.h"
#include "common/tracing/ray_changes.h"

namespace ninefold {

bool PathChanges::concern(Vec3 a, Vec3 b) const {
  if (everywhere) return true;
  // Most ways lie on one side of all boxes.
  const Vec3 low = glm::min(a, b), high = glm::max(a, b);
  if (glm::any(glm::lessThan(high, all.low)) || glm::any(glm::greaterThan(low, all.high)))
    return false;
  const auto meets = [&](const Bounds& box) { return meetsBox(box, a, b - a, 1); };
  return meets(all) && std::ranges::any_of(boxes, meets);
}

PathWorld::PathWorld(const Transport& t, const MinorLamps& minor)
    : settings_(t.settings),
      streams_(t.streams.count()),
      lamps_(lampsStamp(t, minor)),
      hasSolids_(!t.solidBounds.empty()),
      answers_(t.tracer.answers()),
      solidRanks_(solidRanks(t.scene)) {
  for (const Instance& instance : t.scene.instances) {
    const Mesh& mesh = t.scene.meshes[static_cast<size_t>(instance.mesh)];
    materials_.push_back(materialStamp(t.scene.materials[static_cast<size_t>(mesh.material)]));
  }
}

const PathChanges& PathWorld::since(const std::shared_ptr<const PathWorld>& then) const {
  static const PathChanges kNone;
  if (then.get() == this) return kNone;
  const std::lock_guard lock(mutex_);
  std::erase_if(known_, [](const Known& known) { return known.then.expired(); });
  const auto found =
      std::ranges::find_if(known_, [&](const Known& known) { return known.then.lock() == then; });
  if (found != known_.end()) return *found->changes;
  known_.push_back({then, std::make_unique<const PathChanges>(changesSince(*then))});
  return *known_.back().changes;
}

Metres PathWorld::margin() const { return answers_->margin; }

PathChanges PathWorld::changesSince(const PathWorld& then) const {
  const StateFacts* facts = factsOf(settings_.method).state;
  const auto moved = rayChanges(*then.answers_, *answers_);
  if (!moved || !facts->isKept(then.settings_, settings_) || then.streams_ != streams_ ||
      then.solidRanks_ != solidRanks_ || then.materials_.size() != materials_.size())
    return {.everywhere = true};
  PathChanges changes{.starts = then.lamps_ != lamps_, .solids = then.hasSolids_ || hasSolids_};
  for (const Bounds& box : *moved) changes.add(box);
  for (uint32_t i = 0; i < materials_.size(); ++i)
    if (materials_[i] != then.materials_[i]) changes.add(boxOf(*answers_, i));
  return changes;
}

}  // namespace ninefold
