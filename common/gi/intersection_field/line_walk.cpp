#include "common/gi/intersection_field/line_walk.h"

namespace ninefold {

SceneNodeLines::SceneNodeLines(const LineField& field, const Scene& scene,
                               const SceneElements& elements, const LineField* fieldBefore,
                               const SceneElements* elementsBefore, const SceneNodeLines* before) {
  for (uint32_t i = 0; i < field.instances(); ++i) {
    const bool isKept = before != nullptr && field.isShared(*fieldBefore, i) &&
                        elements.isShared(*elementsBefore, i);
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

float LineWalk::gain(const ShadingPoint& p) const {
  const SurfacePoint& s = p.surface;
  const ElementPlace place = elements.block(s.instance).at(s.triangle, s.u, s.v);
  float sum = 0;
  for (size_t c = 0; c < 3; ++c)
    sum += place.weights[c] * lines.of(s.instance).gain(place.nodes[c]);
  return sum;
}

WayOn LineWalk::leave(const ShadingPoint& p, Vec2 u) const {
  const SurfacePoint& s = p.surface;
  const ElementPlace place = elements.block(s.instance).at(s.triangle, s.u, s.v);
  const size_t corner = u.y < place.weights[0]                      ? 0
                        : u.y < place.weights[0] + place.weights[1] ? 1
                                                                    : 2;
  const auto start = lines.of(s.instance).choose(field, place.nodes[corner], u.x);
  if (!start) return cosineWay(p, u);
  const Vec3 along = field.grid().directionOf(start->line);
  const float cosine = glm::dot(along, tracer.frontNormal(s.instance, start->hit.triangle));
  if (cosine == 0) return cosineWay(p, u);
  const bool isForward = (cosine > 0) == (p.front != place.isTurned);
  const auto next = field.next(start->line, start->hit.t, isForward);
  WayOn way{field.grid().pointAt(start->line, start->hit.t), isForward ? along : -along,
            Hit::none()};
  if (!next) return way;
  const Vec2 at = field.placeOf(start->line, *next);
  const float distance = std::abs(next->t - start->hit.t) * field.grid().lengthOf(start->line);
  way.hit = Hit{next->instance, next->triangle, at.x, at.y, distance};
  return way;
}

}  // namespace ninefold
