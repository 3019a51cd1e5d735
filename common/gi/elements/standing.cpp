#include "common/gi/elements/standing.h"

#include <algorithm>
#include <cmath>

#include "common/math/rounding.h"

namespace ninefold {
namespace {

constexpr float kRows = 4;          // in h
constexpr uint32_t kMostLooks = 2;  // along an element's side
constexpr float kElementReach = 0.25f,
                kRowReach = 2;   // [h]; that of rows has those of elements in it
constexpr float kBeside = 0.3f;  // of an element, from a hit: something may stand between two

// visit(from, to): rows along each edge of a triangle, `spacing` from each other, by barycentrics.
template <typename Visit>
void forEachRow(const Tracer::Corners& t, Metres spacing, const Visit& visit) {
  const float twiceArea = glm::length(glm::cross(t.b - t.a, t.c - t.a));
  const auto along = [&](Vec3 edge, const auto& row) {
    const float rows = std::ceil(twiceArea / (glm::length(edge) * spacing));
    for (float r = 0.5f; r < rows; ++r) row(r / rows);
  };
  along(t.b - t.a, [&](float v) { visit(Vec2(0, v), Vec2(1 - v, v)); });
  along(t.c - t.a, [&](float u) { visit(Vec2(u, 0), Vec2(u, 1 - u)); });
  along(t.c - t.b, [&](float sum) { visit(Vec2(sum, 0), Vec2(0, sum)); });
}

}  // namespace

bool SceneChanges::areNear(std::initializer_list<Vec3> points, Metres reach) const {
  if (areAllOver) return true;
  Bounds box;
  for (const Vec3& p : points) box.add(p);
  box.low -= Vec3(reach), box.high += Vec3(reach);
  return std::ranges::any_of(boxes, [&](const Bounds& b) { return meets(box, b); });
}

bool SceneChanges::areNear(const Tracer& tracer, uint32_t instance, const ElementBlock& block,
                           uint32_t triangle) const {
  const Tracer::Corners at = tracer.corners(instance, triangle);
  return areNear({at.a, at.b, at.c}, kRowReach * block.size());
}

bool SceneChanges::areNear(const Tracer& tracer, uint32_t instance, const ElementBlock& block,
                           const Element& e) const {
  if (areAllOver) return true;
  const Tracer::Corners at = tracer.corners(instance, e.triangle);
  const Vec3 origin(tracer.scene().instances[instance].toWorld[3]);
  const auto corner = [&](size_t c) {
    return pointOnTriangle(at.a, at.b, at.c, e.corners[c].x, e.corners[c].y);
  };
  const auto node = [&](size_t c) { return origin + block.position(e.nodes[c]); };
  return areNear({corner(0), corner(1), corner(2), node(0), node(1), node(2)},
                 kElementReach * block.size());
}

std::vector<bool> standingOn(const Tracer& tracer, uint32_t instance, const ElementBlock& block,
                             uint32_t triangle, const SceneChanges& changes) {
  const Tracer::Corners at = tracer.corners(instance, triangle);
  const uint32_t n = block.cuts(triangle), first = block.at(triangle, 0, 0).element;
  const SurfaceSight sight{tracer, block.size()};
  const float beside = kBeside / static_cast<float>(n);
  std::vector<bool> standing(size_t{2} * n * n, false);
  for (const bool isBack : {false, true}) {
    const Vec3 normal = (isBack ? -1.0f : 1.0f) * tracer.frontNormal(instance, triangle);
    const auto mark = [&](uint32_t element) { standing[2 * (element - first) + isBack] = true; };
    forEachRow(at, block.size() / kRows, [&](Vec2 from, Vec2 to) {
      const Vec3 start = pointOnTriangle(at.a, at.b, at.c, from.x, from.y);
      const Vec3 end = pointOnTriangle(at.a, at.b, at.c, to.x, to.y);
      if (!changes.areNear({start, end}, kRowReach * block.size())) return;
      sight.forEachStanding(start, normal, end, [&](float t) {
        const Vec2 uv = from + t * (to - from);
        for (const Vec2 by : {Vec2(1, 0), Vec2(-1, 0), Vec2(0, 1), Vec2(0, -1)})
          mark(block.at(triangle, uv.x + beside * by.x, uv.y + beside * by.y).element);
      });
    });
    block.forEachElement(triangle, [&](const Element& e) {
      if (!changes.areNear(tracer, instance, block, e)) return;
      forEachMiddle(piecesAlong(e, block.size(), kMostLooks), [&](const auto& weights) {
        if (sight.isCovered(instance, triangle, e.at(weights), isBack)) mark(e.number);
      });
    });
  }
  return standing;
}

uint32_t piecesAlong(const Element& e, Metres size, uint32_t most) {
  const float wanted = std::ceil(static_cast<float>(most) * std::sqrt(2 * e.area) / size);
  return static_cast<uint32_t>(std::clamp(wanted, 1.0f, static_cast<float>(most)));
}

}  // namespace ninefold
