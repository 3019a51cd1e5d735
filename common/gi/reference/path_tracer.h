// path_tracer.h: the reference. What one surface point sends to the eye by unbiased path tracing:
// lights sampled at each vertex with multiple importance sampling, roulette, no bound on any term,
// no depth limit unless asked.
//
//   L = sum over vertices of  T (L_e weighted + lights sampled directly weighted)
//   T *= lobe weight / probability
//
//   T     throughput, the product of lobe weights over probabilities
//   L_e   emission that the path meets; like the lights weighted by the balance heuristic
//
// At each vertex one lobe, D or S, is chosen first, and both techniques work for that lobe alone.
// So D vertices are counted exactly as by the virtual point lights, and limits cut both methods
// alike: path-length, --caustics (no lobe that focuses after D; no D after that) and --direct-vpls
// 0 (no light straight to the first D). The first kSureVertices vertices survive for sure, later
// ones with the probability of the lobes' albedo.
//
// Dimensions of vertex j = 1, 2, ...: 8j direction; 8j+2 choice; 8j+3 inside the lobe; 8j+4,
// 8j+5 light.
//
// Its walk stays apart from that of eye_path.h, which is much alike: a fault in common code would
// be in both pictures, and comparing them would not show it.
//
// Fails:   caustics of punctual lights (L is a point, S is smooth): no path finds them, and the log
//          says so (leftOut in scene/methods.h).
// Source:  Kajiya 1986; Veach 1997.
// Proved:  tests/gi (furnace, polygon light, agreement with photons and VPLs).
// Threads: pure functions.   Errors: none.
#pragma once

#include "common/base/counters.h"
#include "common/gi/light/transport.h"
#include "common/sampling/sampler.h"

namespace ninefold {

// Paths a pixel and frame, so that a task is worth its message.
inline constexpr uint32_t kPathsPerPixel = 4;

struct PathLight {
  Radiance all{0};
  Radiance caustic{0};  // part of `all`: what came by way of S and the point scattered diffusely
};

// Light that `first`, seen in `media`, scatters towards the eye; without its own emission.
PathLight scatteredLight(const Transport& transport, const ShadingPoint& first,
                         const MediumStack& media, const PixelSampler& sampler, RayCounts& rays);

}  // namespace ninefold
