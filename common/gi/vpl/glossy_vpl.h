// glossy_vpl.h: what a rough S lobe at the end of a light path sends on, for the VPL that stands
// there.
//
//   E(x) += flux A(v) min(cos_x cos_y/d^2, b) cos_s/cos_x      v: from the VPL to x
//   A(v)  = f(v, l) |l.n| / |l.ng|                             [1/sr]
//
// l: direction to where the light came from. n: normal of the lobe of an eye path from v. So A is
// the adjoint of what eye paths do there (particle_scatter.h). The bound is that of G alone; f
// needs none, as a lobe that counts as rough (needs.h) peaks at 1/(4 alpha^2) of a diffuse one.
//
// Measured for kGlossyRoughness: a room with a floor of that roughness, metallic 0.75, under steps,
// 128x96, 256 frames. Error of blocks of 16x16 and of pixels in % of the mean, time of a frame:
//
//   roughness       0.2                0.25               0.3                0.5 (128 frames)
//   VPLs            0.94  8.2  13 ms   0.72  5.6  13 ms   0.58  4.1  14 ms   0.64  2.24  14 ms
//   photons         0.37  2.5  24 ms   0.48  2.4  22 ms   0.39  2.2  23 ms   0.62  2.23  22 ms
//
// Source:  Keller 1997, with the BSDF kept.   Proved: tests/gi/glossy_test.cpp.
// Threads: plain value.   Errors: none; black where no light goes.
#pragma once

#include "common/gi/light/shading.h"

namespace ninefold {

struct GlossyVpl {
  Bsdf bsdf;
  Vec3 ns{0}, ng{0};  // on the side of `towardsLight`
  Vec3 towardsLight{0};
  Flux flux{0};  // that arrived, over n^2 [W]

  // flux A(v) [W/sr], v unit.
  Vec3 intensityOverCosine(Vec3 v) const;
};

}  // namespace ninefold
