// eye_path.h: paths from the eye, E S* D. They split once, at the first hit, into one path for each
// lobe that is there. Later vertices pick one lobe at random.
//
//   layer radiance = throughput (rho/pi) E(x) gain + U
//
//   throughput  product of the lobes' weights, each in [0, 1]; what exceeds 1 is in the gain
//   rho         reflectance of D at x, where the path ends
//   gain        1 / product of the probabilities of the random choices; goes into E and U, so that
//               reflectance stays <= 1
//   U           emission met along E S*, and at rough S vertices the lights sampled directly
//               (balance heuristic against meeting them by the lobe)             [W/(m^2 sr)]
//
// Chains longer than specular-depth end black. Dimensions of vertex j of a layer: 8j direction;
// 8j+2 choice of lobe; 8j+3 inside the lobe; 8j+4, 8j+5 light.
//
// Source:  Wald et al. 2002.   Proved: tests/gi (glass in a furnace is invisible; mirrors).
// Threads: pure functions.   Errors: none.
#pragma once

#include "common/base/counters.h"
#include "common/gi/eye/receivers.h"
#include "common/gi/light/transport.h"
#include "common/sampling/sampler.h"

namespace ninefold {

// Where the path of one layer ended.
struct EyePathEnd {
  bool arrived = false;       // at a diffuse point x
  ShadingPoint x;             // valid if arrived
  int absorber = -1;          // of x, see Receiver
  Reflectance throughput{0};  // up to x
  float gain = 1;
  float distance = 0;      // from the eye to x along the path [m]
  uint16_t chain = 0;      // hash of first object and specular chain, never 0
  Radiance unfiltered{0};  // U
};

// Follows `lobe` of the first hit to the end of its chain. The first hit lies `distance` metres
// from the eye. through: share of light that the medium around the eye leaves on that way.
// firstDimension: 0 mod 8; layers lie eyePathDimensions(settings) apart.
EyePathEnd followLobe(const Transport& transport, const ShadingPoint& first, Lobe lobe,
                      float distance, Reflectance through, const MediumStack& media,
                      const PixelSampler& sampler, uint32_t firstDimension, RayCounts& rays);

inline uint32_t eyePathDimensions(const Settings& settings) {
  return 8 * static_cast<uint32_t>(settings.specularDepth + 1);
}

}  // namespace ninefold
