// transport.h: what every estimator needs of a scene, gathered once: tracer, shader, emitters and the
// streams that sample them, the bound of the geometry term, and the targets that caustic photons aim at.
//
// In a gesture, the state that it began with decides what would otherwise change for all when one
// thing is touched: which share of the samples a lamp and a target get, b, and how far photons are
// spread (photon_radii.h). A gesture that began in the dark has nothing to go by: all is as at rest.
//
// Threads: const after construction. Refers to the Tracer and its Scene.
#pragma once

#include <vector>

#include "common/gi/light/aim_targets.h"
#include "common/gi/light/light_streams.h"
#include "common/gi/light/shading.h"
#include "common/scene/emitters.h"
#include "common/scene/needs.h"
#include "common/scene/settings.h"
#include "common/tracing/tracer.h"

namespace ninefold {

struct Transport {
  // `begun`: of the state that a gesture began with; null at rest.
  Transport(const Tracer& tracer, const Settings& settings, const Transport* begun = nullptr);

  const Tracer& tracer;
  const Scene& scene;
  Settings settings;
  Shader shader;
  Emitters emitters;
  LightStreams streams;
  std::vector<PunctualLight> lights;  // the scene's, moved off surfaces that they lie in
  Needs needs;
  Metres radius;   // R of the scene's bounds, by which b and photons go; of `begun` in a gesture
  float lampFlux;  // of all lamps, largest component [W]; likewise
  float bound;     // b = c/R^2 [1/m^2]
  Metres farRounding;  // how far a ray across the scene may err at its end, see math/rounding.h
  std::vector<AimTarget> targets;
  std::vector<Bounds> straightBounds;  // of what lets light pass straight on; few

  // Bound of the geometry term at an area emitter, from all of which one point was taken with probability P:
  // where G < P/A, such a point adds at most L to E, less than the emitter seen near by does; and a
  // small lamp's light comes back by no ray that meets it by chance.
  float lightBound(uint32_t emitter) const;

  // Whether a path whose D vertices number `count` (x included) is within the length limit.
  bool allows(int count) const { return settings.pathLength == 0 || count <= settings.pathLength; }
};

}  // namespace ninefold
