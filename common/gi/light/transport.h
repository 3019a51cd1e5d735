// transport.h: what every estimator needs of a scene, gathered once: tracer, shader, emitters and
// the streams that sample them, the bound of the geometry term, and the targets of caustic photons.
//
// In a gesture one thing is touched, and the samples of all others shall stay. So the state that it
// began with decides the share of the samples that a lamp and a target get, and how far photons
// are spread (photon_radii.h). A gesture that began in the dark decides nothing.
//
// Owner:   refers to the Tracer and its Scene.   Threads: const after construction.
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
  Metres radius;       // R of the scene's bounds, by which b and photons go
  float lampFlux;      // of all lamps, largest component [W]; of `begun` in a gesture
  float bound;         // b = c/R^2 [1/m^2]
  Metres farRounding;  // how far a ray across the scene may err at its end, see math/rounding.h
  std::vector<AimTarget> targets;
  std::vector<Bounds> straightBounds;  // of what lets light pass straight on; few
  std::vector<Bounds> solidBounds;     // of solids that transmit; few

  // Bound of the geometry term G at an area emitter [1/m^2]; b without compensation.
  //
  //   max(b, P/A)   P: probability of the emitter in its stream, A: its area, of both sides if both
  //                 emit [m^2]
  //
  // One VPL stands for the whole emitter, so it carries the intensity A L/P, L: the emitter's
  // radiance. Where G <= P/A it adds at most L to E, less than the emitter itself does near by: no
  // need to cut. And the light of a small lamp, once cut, is hardly ever met again by a short ray.
  float lightBound(uint32_t emitter) const;

  // Where shadow rays to a point of a surface end: off the surface on n's side, by as much as
  // rounding may do on the way from anywhere in the scene. error: as in SurfacePoint.
  Vec3 rayTarget(Vec3 position, Vec3 n, float error) const {
    return offsetOrigin(position, n, error + farRounding, n);
  }

  // Whether a path whose D vertices number `count` (x included) is within the length limit.
  bool allows(int count) const { return settings.pathLength == 0 || count <= settings.pathLength; }
};

}  // namespace ninefold
