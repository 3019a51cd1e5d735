// sampler.h: addressed random numbers. A sample is a pure function of (key, index, dimension); nothing is
// ever drawn from a shared stream, so any client computes any part of a frame bit for bit.
//
// LightSampler   light set k of a frame takes the k-th aligned block of 2^m points of one randomized Sobol'
//                sequence, so that the K sets together are again well distributed. Dimensions beyond the first
//                kSobolDimensions are padded replications: the same points, with their indices permuted inside
//                the block and a randomization of their own.
// PixelSampler   one sequence per pixel: index = randomization index, so that a pixel's samples over frames
//                complement each other; same padding (permuted inside aligned blocks of 2^m indices).
// Randomization  exclusiveOr: one random word per dimension, as the paper; owen: nested uniform scrambling.
//
// Source:  Kollig and Keller, "Efficient Multidimensional Sampling", 2002; Owen 1995; Burley 2020 (hashed Owen);
//          Keller, "Myths of Computer Graphics" (padding).
// Proved:  tests/sampling (elementary intervals of each block and of unions of 2^j blocks; order independence).
// Threads: const, reentrant. Errors: none. All values are in [0, 1).
#pragma once

#include <cstdint>

#include "common/math/vec.h"
#include "common/sampling/randomization.h"

namespace ninefold {

inline constexpr uint32_t kSobolDimensions = 4;  // joint dimensions of one padded replication

// Mixes any number of words into one well distributed word; the base of all addressing.
uint64_t hashWords(uint64_t a, uint64_t b, uint64_t c = 0, uint64_t d = 0);

// What a stream of samples is for; part of its address so that no two uses share numbers.
enum class SampleUse : uint32_t { lightPath, directVpl, photon, eyePath, gather, rounding, probe };

class LightSampler {
 public:
  // Block `set` of 2^log2Count points; randomization names the frame's randomization index.
  LightSampler(uint64_t seed, SampleUse use, uint32_t randomization, uint32_t set, int log2Count,
               Randomization kind);
  float get1D(uint32_t i, uint32_t dimension) const;  // i in [0, 2^log2Count)
  Vec2 get2D(uint32_t i, uint32_t dimension) const;   // dimensions `dimension` and `dimension + 1`

 private:
  uint64_t key_;
  uint32_t firstIndex_;
  int log2Count_;
  Randomization kind_;
};

class PixelSampler {
 public:
  PixelSampler(uint64_t seed, SampleUse use, uint32_t x, uint32_t y, uint32_t index, Randomization kind);
  float get1D(uint32_t dimension) const;
  Vec2 get2D(uint32_t dimension) const;

 private:
  uint64_t key_;
  uint32_t index_;
  Randomization kind_;
};

}  // namespace ninefold
