#include "common/gi/intersection_field/line_walk.h"

namespace ninefold {

SceneNodeLines::SceneNodeLines(const LineField& field, const Scene& scene,
                               const SceneElements& elements, const LineField* fieldBefore,
                               const SceneElements* elementsBefore, const SceneNodeLines* before) {
  for (uint32_t i = 0; i < field.instances(); ++i) {
    const bool isKept = before != nullptr && field.isShared(*fieldBefore, i) &&
                        elements.isSameBlock(*elementsBefore, i);
    lines_.push_back(isKept
                         ? before->lines_[i]
                         : std::make_shared<const NodeLines>(field, scene, i, elements.block(i)));
  }
}

size_t SceneNodeLines::bytes() const {
  size_t sum = 0;
  for (const auto& lines : lines_) sum += lines->bytes();
  return sum;
}

// Whether nothing stands between p and a place on a surface with this normal, on p's side.
bool LineWalk::isSeen(const ShadingPoint& p, Vec3 place, Vec3 normal) const {
  const Vec3 origin = offsetOrigin(p.surface, p.ng);
  const Vec3 target = place + (p.surface.error + field.grid().rounding()) * normal;
  return !tracer.occluded(origin, target - origin, 1);
}

WayOn LineWalk::leave(const ShadingPoint& p, Vec2 u, RayCounts& rays) const {
  const SurfacePoint& s = p.surface;
  const ElementPlace place = elements.block(s.instance).at(s.triangle, s.u, s.v);
  const size_t corner = u.y < place.weights[0]                      ? 0
                        : u.y < place.weights[0] + place.weights[1] ? 1
                                                                    : 2;
  const bool isFront = p.front != place.isTurned;
  float number = u.x;
  for (int tried = 0; tried < kTries; ++tried) {
    const auto start = lines.of(s.instance).choose(field, place.nodes[corner], number);
    if (!start) break;
    Vec3 normal = tracer.frontNormal(s.instance, start->hit.triangle);
    if (!isFront) normal = -normal;
    const float cosine = glm::dot(field.grid().directionOf(start->line), normal);
    ++rays.shadow;
    if (cosine != 0 && isSeen(p, field.grid().pointAt(start->line, start->hit.t), normal))
      return along(*start, cosine > 0);
    number += 0.618034f, number -= std::floor(number);
  }
  return cosineWay(p, u);
}

WayOn LineWalk::along(const NodeLines::Start& start, bool isForward) const {
  const LineGrid& grid = field.grid();
  const Vec3 way = grid.directionOf(start.line);
  WayOn on{grid.pointAt(start.line, start.hit.t), isForward ? way : -way, Hit::none()};
  const auto next = field.next(start.line, start.hit.t, isForward);
  if (!next) return on;
  const Vec2 at = field.placeOf(start.line, *next);
  const float distance = std::abs(next->t - start.hit.t) * grid.lengthOf(start.line);
  on.hit = Hit{next->instance, next->triangle, at.x, at.y, distance};
  return on;
}

float LineWalk::gain(const ShadingPoint& p) const {
  const SurfacePoint& s = p.surface;
  const ElementPlace place = elements.block(s.instance).at(s.triangle, s.u, s.v);
  float sum = 0;
  for (size_t c = 0; c < 3; ++c)
    sum += place.weights[c] * lines.of(s.instance).gain(place.nodes[c]);
  return sum;
}

}  // namespace ninefold
