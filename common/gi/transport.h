// transport.h: what every estimator needs of a scene, gathered once: tracer, shader, emitters, the
// bound of the geometry term, and the targets that caustic photons aim at. Threads: const after
// construction. Refers to the Tracer and its Scene.
#pragma once

#include <vector>

#include "common/gi/shading.h"
#include "common/scene/emitters.h"
#include "common/scene/needs.h"
#include "common/scene/settings.h"
#include "common/tracing/tracer.h"

namespace ninefold {

// A sphere around objects with S lobes.
struct AimTarget {
  Vec3 centre{0};
  float radius = 0;  // [m]
};

struct Transport {
  Transport(const Tracer& tracer, const Settings& settings);

  const Tracer& tracer;
  const Scene& scene;
  Settings settings;
  Shader shader;
  Emitters emitters;
  std::vector<PunctualLight> lights;  // the scene's, moved off surfaces that they lie in
  Needs needs;
  float bound;         // b = c/R^2 [1/m^2]
  Metres farRounding;  // how far a ray across the scene may err at its end, see math/rounding.h
  std::vector<AimTarget> targets;  // empty if nothing is specular; at most kMaxTargets

  static constexpr size_t kMaxTargets = 16;

  // Bound of the geometry term at an area emitter, from all of which one point was taken with probability P:
  // where G < P/A, such a point adds at most L to E, less than the emitter seen near by does; and a
  // small lamp's light comes back by no ray that meets it by chance.
  float lightBound(uint32_t emitter) const;

  // Whether a path whose D vertices number `count` (x included) is within the length limit.
  bool allows(int count) const { return settings.pathLength == 0 || count <= settings.pathLength; }
};

}  // namespace ninefold
