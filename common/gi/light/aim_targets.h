// aim_targets.h: what caustic photons aim at: spheres around the objects that focus light.
//
// In a gesture each target moves with its objects, and the photons' directions with it. Its share
// of the photons stays as the gesture found it (emission.h), so that photons of the others stay as
// they are. When another set of objects focuses light than then, targets are made anew.
//
// Threads: pure function.   Errors: none.   Proved: tests/gi/gesture_test.cpp.
#pragma once

#include <vector>

#include "common/gi/light/shading.h"
#include "common/scene/scene.h"

namespace ninefold {

struct Sphere {
  Vec3 centre{0};
  float radius = 0;  // [m]
  bool operator==(const Sphere&) const = default;
};

struct AimTarget {
  Sphere now, begun;       // begun: when the gesture began; at rest the same
  std::vector<int> nodes;  // Instance::node of the objects inside
};

inline constexpr size_t kMaxTargets = 16;

// Empty if nothing focuses light. `begun`: the targets that a gesture began with; null at rest.
std::vector<AimTarget> aimTargets(const Scene& scene, const Shader& shader,
                                  const std::vector<AimTarget>* begun);

}  // namespace ninefold
