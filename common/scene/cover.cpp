#include "common/scene/cover.h"

#include <algorithm>
#include <utility>

#include "common/scene/world.h"

namespace ninefold {
namespace {

constexpr float kGrowth = 1.25f;

// Of what has no extent, so that growth ends [m].
double leastHalf(const Bounds& bounds) { return 1e-3 * std::max(1e-3, double(bounds.radius())); }

// The smallest box kGrowth^i times as wide as `box` that holds p too.
void growTo(Bounds& box, double least, Vec3 p) {
  for (int axis = 0; axis < 3; ++axis) {
    if (p[axis] >= box.low[axis] && p[axis] <= box.high[axis]) continue;
    const double middle = 0.5 * (double(box.low[axis]) + double(box.high[axis]));
    double half = std::max(least, 0.5 * (double(box.high[axis]) - double(box.low[axis])));
    while (half < std::abs(double(p[axis]) - middle)) half *= kGrowth;
    box.low[axis] = static_cast<float>(middle - half);
    box.high[axis] = static_cast<float>(middle + half);
  }
}

}  // namespace

Bounds coverBox(const Scene& scene) {
  return scene.cover.box.empty() ? scene.bounds : scene.cover.box;
}

Metres coverRadius(const Scene& scene) { return scene.cover.ballScale * scene.bounds.radius(); }

void coverInstance(Scene& scene, size_t instance) {
  const auto& meshes = std::as_const(scene).meshes;  // const: a list of meshes stays shared
  const Instance& placed = scene.instances[instance];
  const double least = leastHalf(scene.bounds);
  const DVec3 middle(scene.bounds.centre());
  double farthest = 0;
  Bounds box = coverBox(scene);
  for (const Vec3& position : meshes[static_cast<size_t>(placed.mesh)].positions) {
    const Vec3 p = worldPoint(placed.toWorld, position);
    growTo(box, least, p);
    farthest = std::max(farthest, glm::distance(DVec3(p), middle));
  }
  while ((1 + double{kBallRounding}) * double{coverRadius(scene)} < farthest)
    scene.cover.ballScale *= kGrowth;
  const bool isWider = box.low != scene.bounds.low || box.high != scene.bounds.high;
  if (isWider) scene.cover.box = box;
}

}  // namespace ninefold
