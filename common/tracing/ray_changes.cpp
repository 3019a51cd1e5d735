#include "common/tracing/ray_changes.h"

#include <algorithm>

#include "common/math/rounding.h"
#include "common/tracing/geometry.h"
#include "common/tracing/part.h"

namespace ninefold {
namespace {

constexpr size_t kMostTriangles = 16;  // of an instance, with boxes of their own

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
  std::vector<Bounds> found;
  for (uint32_t t = 0; t < std::max(was.size(), is.size()); ++t)
    if (touches(was, t) != touches(is, t)) found.push_back(triangleBox(now, instance, t));
  if (found.size() > kMostTriangles) found = {boxOf(now, instance)};
  boxes.insert(boxes.end(), found.begin(), found.end());
}

// Whether rays have the same answers in both; null: there is none.
bool areAlike(const Part* a, const Part* b) {
  return a == b || (a != nullptr && b != nullptr && a->isLike(*b));
}

}  // namespace

Bounds boxOf(const RayAnswers& answers, uint32_t instance) {
  return widened(answers.geometries[instance]->bounds(), answers.margin);
}

std::optional<std::vector<Bounds>> rayChanges(const RayAnswers& before, const RayAnswers& now) {
  if (before.margin != now.margin || before.shows.size() != now.shows.size()) return std::nullopt;
  std::vector<Bounds> boxes;
  for (uint32_t i = 0; i < now.shows.size(); ++i) {
    const bool wasSeen = before.shows[i] != nullptr, isSeen = now.shows[i] != nullptr;
    if (areAlike(before.shows[i].get(), now.shows[i].get()) && before.ranks[i] == now.ranks[i]) {
      if (isSeen) addTouching(before, now, i, boxes);
      continue;
    }
    if (wasSeen) boxes.push_back(boxOf(before, i));
    if (isSeen && (!wasSeen || now.geometries[i] != before.geometries[i]))
      boxes.push_back(boxOf(now, i));
  }
  return boxes;
}

}  // namespace ninefold
