// path_tracer.h: the reference. What one surface point sends to the eye by unbiased path tracing:
// lights sampled at each vertex with multiple importance sampling, roulette, no bound on any term,
// no depth limit unless asked.
//
//   L = sum over vertices of  T (L_e weighted + lights sampled directly weighted)
//   T *= lobe weight / probability
//
// At each vertex one lobe, D or S, is chosen first, and both techniques work for that lobe alone:
// so D vertices are counted exactly as by the virtual point lights, and path-length cuts both
// methods alike. So do --caustics (no lobe that focuses after D; no D after that) and --direct-vpls
// 0 (no light straight to the first D). The first kSureVertices vertices survive for sure; later
// ones with the probability of the lobes' albedo. It cannot find a caustic of a punctual light (L
// is a point, S is smooth): those paths are missing, and the log says so (leftOut in
// scene/needs.h).
//
// Dimensions of vertex j, from 1 on: 8j direction; 8j+2 choice; 8j+3 inside the lobe; 8j+4, 5 light.
//
// Source:  Kajiya 1986; Veach 1997.
// Proved:  tests/gi (furnace, polygon light, agreement with photons and VPLs).
// Threads: pure functions.   Errors: none.
#pragma once

#include "common/base/counters.h"
#include "common/gi/light/transport.h"
#include "common/sampling/sampler.h"

namespace ninefold {

inline constexpr uint32_t kPathsPerPixel =
    4;  // paths a pixel and frame, so that a task is worth its message

struct PathLight {
  Radiance all{0};
  Radiance caustic{0};  // of `all`, what the point scattered diffusely after it came by way of S
};

// Light that `first`, seen in `media`, scatters towards the eye; what it emits is not in it.
PathLight scatteredLight(const Transport& transport, const ShadingPoint& first,
                         const MediumStack& media, const PixelSampler& sampler, RayCounts& rays);

}  // namespace ninefold
