// receiver_samples.h: the random numbers of a task's receivers, by pixel, layer and level.
//
// Level: the number of D vertices between the eye and the receiver, pathVertices of
// layered_method.h. A receiver is one sample of its pixel and frame, with nothing to stratify it
// against. So the numbers are plain hashes, no points of a Sobol' sequence.
// Threads: pure functions.
#pragma once

#include "common/sampling/sampler.h"

namespace ninefold {

class ReceiverSamples {
 public:
  ReceiverSamples(uint64_t seed, uint32_t randomization, uint32_t layer)
      : key_(hashWords(seed, static_cast<uint64_t>(SampleUse::gather),
                       uint64_t{randomization} << 32 | layer)),
        layer_(layer),
        glossyPaths_(seed, SampleUse::glossyPath, randomization, 1, Randomization::owen) {}

  // pixel: x + width * y in the whole image, as in Receiver.
  Vec2 compensationDirection(uint32_t pixel, int level) const {
    const uint64_t w = word(pixel, level, 0);
    return Vec2(unitFloat(static_cast<uint32_t>(w >> 32)), unitFloat(static_cast<uint32_t>(w)));
  }
  float compensationRoulette(uint32_t pixel, int level) const {
    return unitFloat(static_cast<uint32_t>(word(pixel, level, 1)));
  }
  float vplChoice(uint32_t pixel, int level) const {
    return unitFloat(static_cast<uint32_t>(word(pixel, level, 2)));
  }
  // Of the path that goes on from a glossy surface.
  PixelSampler glossyPath(uint32_t pixel, int level) const {
    return PixelSampler(glossyPaths_, pixel, layer_ << 16 | static_cast<uint32_t>(level), 0);
  }

 private:
  static constexpr uint64_t kUses = 3;

  uint64_t word(uint32_t pixel, int level, uint64_t use) const {
    const uint64_t dimension = kUses * static_cast<uint64_t>(level) + use;
    return mixWord(key_ + 0x9e3779b97f4a7c15ull * (dimension << 32 | pixel));
  }

  uint64_t key_;
  uint32_t layer_;
  PixelStream glossyPaths_;
};

}  // namespace ninefold
