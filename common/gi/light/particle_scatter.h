// particle_scatter.h: how particles from the lights scatter at an S lobe: the exact adjoint of what
// eye paths do there, also where normals are interpolated.
//
// An eye path from direction v has its lobe about ns if v is in front of ns, else about the true
// normal ng, so that no silhouette is black (ShadingPoint::frame). A particle from direction l must
// scatter with the same f, which depends on its outgoing direction v:
//
//   v in front of ns   f about ns (none if l is behind ns),  factor |l.ns v.ng| / (|l.ng v.ns|)
//   v behind ns        f about ng,                           factor 1
//
// Each of the two sets of v is sampled by its own lobe; a direction that falls into the other set
// ends the particle. The second set is as small as the angle between ns and ng. It is chosen with
// probability |ns - ng|/2.
//
// Source:  Veach 1997, 5.3 (shading normals); the split was written for this project.
// Proved:  tests/gi (flux there and back between all pairs of directions; methods agree).
// Threads: pure functions.   Errors: none; nullopt means "no light goes there".
#pragma once

#include <optional>

#include "common/gi/light/shading.h"

namespace ninefold {

struct ScatteredParticle {
  Vec3 wi;      // unit, world
  Vec3 weight;  // of the flux; above 1 where the normals disagree
  bool smooth;  // no other direction was possible
};

// At `p`, met from p.wo. uLobe as for sampleLobe; uNormal chooses between the two sets of
// directions.
std::optional<ScatteredParticle> scatterParticle(const ShadingPoint& p, Lobe lobe, Vec2 u,
                                                 float uLobe, float uNormal);

}  // namespace ninefold
