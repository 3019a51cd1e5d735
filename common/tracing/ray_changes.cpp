#include "common/tracing/ray_changes.h"

#include <algorithm>

#include "common/math/rounding.h"
#include "common/tracing/geometry.h"
#include "common/tracing/part.h"

namespace ninefold {

namespace {

// Larger by what matters to contacts, and by what coordinates there are rounded by.
Bounds widened(Bounds box, Metres margin) {
  const Vec3 far = glm::max(glm::abs(box.low), glm::abs(box.high));
  const float rounding = 16 * kUnitRoundoff * std::max({far.x, far.y, far.z});
  box.low -= 4 * margin + rounding, box.high += 4 * margin + rounding;
  return box;
}

Bounds triangleBox(const RayAnswers& answers, uint32_t instance, uint32_t triangle) {
  const Tracer::Corners at = answers.geometries[instance]->corners(triangle);
  Bounds box;
  box.add(at.a), box.add(at.b), box.add(at.c);
  return widened(box, answers.margin);
}

bool touches(const std::vector<bool>& triangles, uint32_t triangle) {
  return !triangles.empty() && triangles[triangle];
}

// Of triangles that have begun or ceased to touch something: rays that end on them look around.
void addTouching(const RayAnswers& before, const RayAnswers& now, uint32_t instance,
                 std::vector<Bounds>& boxes) {
  const std::vector<bool>&was = before.touching[instance], &is = now.touching[instance];
  if (was == is) return;
  for (uint32_t t = 0; t < std::max(was.size(), is.size()); ++t)
    if (touches(was, t) != touches(is, t)) boxes.push_back(triangleBox(now, instance, t));
}

}  // namespace

bool answerAlike(const Part* a, const Part* b) {
  return a == b || (a != nullptr && b != nullptr && a->isLike(*b));
}

Bounds boxOf(const RayAnswers& answers, uint32_t instance) {
  return widened(answers.geometries[instance]->bounds(), answers.margin);
}

std::optional<std::vector<Bounds>> rayChanges(const RayAnswers& before, const RayAnswers& now) {
  if (before.margin != now.margin || before.shows.size() != now.shows.size()) return std::nullopt;
  std::vector<Bounds> boxes;
  for (uint32_t i = 0; i < now.shows.size(); ++i) {
    if (before.shows[i] == now.shows[i]) {
      addTouching(before, now, i, boxes);
      continue;
    }
    boxes.push_back(boxOf(before, i));
    if (now.geometries[i] != before.geometries[i]) boxes.push_back(boxOf(now, i));
  }
  return boxes;
}

}  // namespace ninefold
