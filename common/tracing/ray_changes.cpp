#include "common/tracing/ray_changes.h"

#include <algorithm>

#include "common/math/rounding.h"
#include "common/tracing/geometry.h"

namespace ninefold {

// Larger by what matters to contacts, and by what coordinates there are rounded by.
Bounds boxOf(const RayAnswers& answers, uint32_t instance) {
  Bounds box = answers.geometries[instance]->bounds();
  const Vec3 far = glm::max(glm::abs(box.low), glm::abs(box.high));
  const float rounding = 16 * kUnitRoundoff * std::max({far.x, far.y, far.z});
  box.low -= 4 * answers.margin + rounding, box.high += 4 * answers.margin + rounding;
  return box;
}

std::optional<std::vector<Bounds>> rayChanges(const RayAnswers& before, const RayAnswers& now) {
  if (before.margin != now.margin || before.shows.size() != now.shows.size() ||
      before.touching != now.touching)
    return std::nullopt;
  std::vector<Bounds> boxes;
  for (uint32_t i = 0; i < now.shows.size(); ++i) {
    if (before.shows[i] == now.shows[i]) continue;
    boxes.push_back(boxOf(before, i));
    if (now.geometries[i] != before.geometries[i]) boxes.push_back(boxOf(now, i));
  }
  return boxes;
}

}  // namespace ninefold
