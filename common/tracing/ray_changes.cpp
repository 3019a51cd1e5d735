#include "common/tracing/ray_changes.h"

#include "common/tracing/geometry.h"

namespace ninefold {

Bounds boxOf(const RayAnswers& answers, uint32_t instance) {
  Bounds box = answers.geometries[instance]->bounds();
  box.low -= 4 * answers.margin, box.high += 4 * answers.margin;
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
