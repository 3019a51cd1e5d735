// emission.h: particles leave the lights, in the ordinary way or aimed at specular objects.
//
// Ordinary: an emitter by power, then position and direction in proportion to what it emits.
//   triangle     A uniform, cos/pi         flux = sides pi A L / P
//   point        uniform directions        flux = 4 pi I / P
//   spot         uniform in the cone       flux = 2 pi (1-cos outer) I(omega) / P
//   goniometric  I(omega)/(I Omega)        flux = I Omega / P, see profile_sampling.h
//   directional  disk of radius r          flux = pi r^2 E0 / P
//   environment  directions, then disk     flux = pi r^2 L(w) / (q(w) P), q as in direct_light.h
// r: a little more than that of the ball around the scene (cover.h). P: probability of the emitter
// in its stream (light_streams.h). A sample of an emitter that is off now carries nothing.
//
// Aimed: the direction (for parallel light: the place on the disk) comes from a mixture q.
//   flux = J(omega) / q(omega),  J = emitted W/sr (parallel light: W/m^2) divided by P
//   q    = kOrdinaryShare of the ordinary density, the rest in cones (disks) around the targets
// So every direction that emits has density > 0, and no flux exceeds 1/kOrdinaryShare of the
// ordinary one. In a gesture a target's share of q is that of its beginning, its cone that of now.
// A target without one of the two gets nothing.
//
// Units:   flux [W], not yet divided by the number of particles.
// Source:  Jensen 1996 (projection maps, here as cones with a mixture density).
// Proved:  tests/gi (mean flux into a closed box equals the emitters' power, ordinary and aimed).
// Threads: pure functions.   Errors: none; a black flux means nothing was emitted there.
#pragma once

#include "common/gi/light/transport.h"

namespace ninefold {

struct Particle {
  Vec3 origin{0};     // already moved off the surface
  Vec3 direction{0};  // unit
  Flux flux{0};
  bool punctual = false;  // from a light that no ray meets
  uint32_t lamp = 0;      // lampOf its emitter; 0 if it has none
};

inline constexpr float kOrdinaryShare = 0.2f;

// u: four joint sample dimensions; emitter choice and first position coordinate share u[0].
Particle emitParticle(const Transport& transport, size_t stream, Vec2 u01, Vec2 u23);

// The same with fewer numbers: what the choice of the emitter leaves of `main.x` and `main.y` tell
// the direction (parallel light: the place on the disk), `rest` the place (environment: on the
// disk). So particles with almost equal `main` leave one lamp almost alike.
Particle emitAlike(const Transport& transport, size_t stream, Vec2 main, Vec2 rest);

// uTarget chooses between the ordinary emission and a target.
Particle emitAimed(const Transport& transport, size_t stream, Vec2 u01, Vec2 u23, float uTarget);

// A Lambertian source point, e.g. a D vertex of a light path: radiates `flux` with density cos/pi
// about `normal`; the particle is aimed by the same mixture.
struct LambertSource {
  Vec3 position{0};
  Vec3 normal{0};
  float error = 0;
  Flux flux{0};
};
Particle emitAimed(const Transport& transport, const LambertSource& source, Vec2 u, float uTarget);

}  // namespace ninefold
