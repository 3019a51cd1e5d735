// receiver_samples.h: the sample points of a task's receivers, addressed by pixel and layer.
//
// Dimensions at level j, the number of D vertices between the eye and the receiver: 4j, 4j+1 direction
// of the compensation's ray; 4j+2 whether it is followed; 4j+3 choice of VPLs.
// Threads: pure functions.
#pragma once

#include "common/sampling/sampler.h"

namespace ninefold {

struct ReceiverSamples {
  uint64_t seed = 0;
  uint32_t randomization = 0;
  Randomization kind = Randomization::owen;
  uint32_t layer = 0;

  // pixel: any number that names the pixel in the whole image. pathVertices as in irradiance.h.
  Vec2 compensationDirection(uint32_t pixel, int pathVertices) const {
    return of(pixel).get2D(dimension(pathVertices));
  }
  float compensationRoulette(uint32_t pixel, int pathVertices) const {
    return of(pixel).get1D(dimension(pathVertices) + 2);
  }
  float vplChoice(uint32_t pixel, int pathVertices) const {
    return of(pixel).get1D(dimension(pathVertices) + 3);
  }

 private:
  static uint32_t dimension(int pathVertices) {
    return 4 * static_cast<uint32_t>(pathVertices - 1);
  }
  PixelSampler of(uint32_t pixel) const {
    return PixelSampler(seed, SampleUse::gather, pixel, layer, randomization, 0, kind);
  }
};

}  // namespace ninefold
