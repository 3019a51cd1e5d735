// line_rays.h: the hits of an intersection field's lines held against Embree's along them.
#pragma once

#include "common/gi/intersection_field/line_field.h"
#include "common/tracing/tracer.h"

namespace ninefold::testing {

// Hits of the line's whole length by rays, one after the other; `reach`: so far.
inline std::vector<Hit> tracedHits(const Tracer& tracer, Vec3 origin, Vec3 way, Metres reach) {
  std::vector<Hit> hits;
  for (float done = 0; hits.size() < 100;) {
    Hit hit = tracer.closest(origin + done * way, way, reach);
    if (!hit) break;
    hit.t += done, done = hit.t + 1e-6f * reach;
    hits.push_back(hit);
  }
  return hits;
}

struct LineCounts {
  size_t all = 0, unlike = 0;
};

// Every `every`-th line: the same surfaces at the same places. A line that is near an edge, or goes
// along a surface, may meet one triangle or the other; such lines are few.
inline LineCounts heldAgainstRays(const LineField& field, const Tracer& tracer, uint32_t every) {
  const LineGrid& grid = field.grid();
  const float radius = tracer.scene().bounds.radius(), near = 1e-4f * radius;
  std::vector<LineHit> hits;
  LineCounts counts;
  for (uint32_t number = 0; number < grid.lines(); number += every) {
    const GridLine line = grid.lineOf(number);
    const Vec3 way = grid.directionOf(line);
    const Vec3 origin = grid.pointAt(line, 0) - 3 * radius * way;
    field.hitsOf(line, hits);
    const std::vector<Hit> traced = tracedHits(tracer, origin, way, 10 * radius);
    bool isLike = hits.size() == traced.size();
    for (size_t k = 0; isLike && k < hits.size(); ++k) {
      const float t = 3 * radius + hits[k].t * grid.lengthOf(line);
      const Vec3 n = tracer.frontNormal(hits[k].instance, hits[k].triangle);
      const float reach = near / std::max(std::abs(glm::dot(n, way)), 1e-3f);
      isLike = hits[k].instance == traced[k].instance && std::abs(t - traced[k].t) < reach;
    }
    ++counts.all, counts.unlike += isLike ? 0 : 1;
  }
  return counts;
}

}  // namespace ninefold::testing
