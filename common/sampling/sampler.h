// sampler.h: addressed random numbers. A sample is a pure function of (key, index, dimension).
// Nothing is drawn from a shared stream, so any client computes any part of a frame by itself.
//
// LightSampler   Light set k of a frame takes the k-th aligned block of 2^m points of one
//                randomized Sobol' sequence, so that K sets together are well distributed, too.
//                Dimensions beyond the first kSobolDimensions are padded replications: the same
//                points, their indices permuted inside the block, with their own randomization.
// PixelSampler   Each pixel has eight sequences, each randomized by itself. Frame f goes on with
//                sequence f mod 8. So all paths of a pixel complement each other, edges converge
//                faster than by chance, and the spread of the eight replications states the error.
// Randomization  exclusiveOr: one random word per dimension, as the paper.
//                owen: nested uniform scrambling.
//                random: plain pseudo-random numbers instead of Sobol' points, to compare with.
//                Padding permutes indices by nested scrambling always: Sobol' points are linear in
//                the bits of the index, so an exclusive-or of indices would repeat the first
//                dimensions.
//
// get2D takes dimensions of one replication: use even ones. Nothing is checked on this hot path.
// All values are multiples of 2^-24 in [0, 1).
//
// Source:  Kollig and Keller, "Efficient Multidimensional Sampling", 2002; Owen 1995; Burley 2020
//          (hashed Owen); Keller, "Myths of Computer Graphics" (padding).
// Proved:  tests/sampling (elementary intervals of each block and of unions of 2^j blocks; order).
// Threads: const, reentrant.   Errors: none.
#pragma once

#include <bit>
#include <cstdint>

#include "common/math/vec.h"
#include "common/sampling/hash.h"
#include "common/sampling/owen.h"
#include "common/sampling/randomization.h"
#include "common/sampling/sobol.h"

namespace ninefold {

// What a stream of samples is for: part of its address, so that no two uses share numbers.
enum class SampleUse : uint32_t {
  lightPath,
  directVpl,
  photon,
  indirectPhoton,
  eyePath,
  gather,
  rounding,
  probe,
  glossyPath,
  cameraPoint,
  reverseVpl,
  resampling,
  mapPhoton,
  groupPhoton,
  fieldPhoton
};

// The least m with 2^m >= n: LightSampler's log2Count for n points.
constexpr int log2Ceil(int n) { return n <= 1 ? 0 : std::bit_width(static_cast<unsigned>(n - 1)); }

// The 24 highest bits as a number in [0, 1); more would round up to 1.
inline float unitFloat(uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }

// One randomized, padded Sobol' sequence. The samplers below only say which key and which index.
struct PaddedSobol {
  uint64_t key;
  Randomization kind;

  // The index inside the replication of `dimension`. It is permuted only in the bits of `mask` =
  // 2^m - 1.
  uint32_t permute(uint32_t index, uint32_t dimension, uint32_t mask) const {
    const uint32_t replication = dimension / kSobolDimensions;
    if (replication == 0) return index;
    const uint64_t seed = mixWord(key ^ (0xd1b54a32d192ed03ull * replication));
    return (index & ~mask) | (owenScramble(index, static_cast<uint32_t>(seed)) & mask);
  }
  float value(uint32_t permuted, uint32_t dimension) const {
    const uint64_t word = mixWord(key + 0x9e3779b97f4a7c15ull * (dimension + 1));
    if (kind == Randomization::random)
      return unitFloat(static_cast<uint32_t>(mixWord(word + permuted)));
    const auto seed = static_cast<uint32_t>(word);
    const uint32_t x = sobolPoint(permuted, dimension % kSobolDimensions);
    return unitFloat(kind == Randomization::owen ? owenScramble(x, seed) : x ^ seed);
  }
  float get1D(uint32_t index, uint32_t dimension, uint32_t mask) const {
    return value(permute(index, dimension, mask), dimension);
  }
  Vec2 get2D(uint32_t index, uint32_t dimension, uint32_t mask) const {
    const uint32_t permuted = permute(index, dimension, mask);
    return Vec2(value(permuted, dimension), value(permuted, dimension + 1));
  }
};

class LightSampler {
 public:
  // Block `set` of 2^log2Count points; log2Count in 0..32, (set + 1) 2^log2Count <= 2^32.
  // `randomization`: the frame's randomization index, the same for all sets of a frame.
  LightSampler(uint64_t seed, SampleUse use, uint32_t randomization, uint32_t set, int log2Count,
               Randomization kind)
      : sobol_{hashWords(seed, static_cast<uint64_t>(use), randomization), kind},
        firstIndex_(static_cast<uint32_t>(uint64_t{set} << log2Count)),
        mask_(static_cast<uint32_t>((uint64_t{1} << log2Count) - 1)) {}

  // i in [0, 2^log2Count)
  float get1D(uint32_t i, uint32_t dimension) const {
    return sobol_.get1D(firstIndex_ + i, dimension, mask_);
  }
  // Dimensions `dimension` (even) and `dimension + 1`.
  Vec2 get2D(uint32_t i, uint32_t dimension) const {
    return sobol_.get2D(firstIndex_ + i, dimension, mask_);
  }
  // Of a light path that goes on from D: see gi/light/light_path.h. The last number is for others.
  Vec2 diffuseDirection(uint32_t i, uint32_t dimension, float) const { return get2D(i, dimension); }

 private:
  PaddedSobol sobol_;
  uint32_t firstIndex_;
  uint32_t mask_;
};

inline constexpr uint32_t kReplications = 8;

// What all pixels of a frame share. `paths`: paths of each pixel in a frame.
class PixelStream {
 public:
  PixelStream(uint64_t seed, SampleUse use, uint32_t randomization, uint32_t paths,
              Randomization kind)
      : key_(hashWords(seed,
                       uint64_t{randomization % kReplications} << 32 | static_cast<uint64_t>(use),
                       kPixelDomain)),
        first_(randomization / kReplications * paths),
        kind_(kind) {}

 private:
  friend class PixelSampler;
  static constexpr uint64_t kPixelDomain = 1;  // keeps pixel keys apart from the keys of light sets
  uint64_t key_;
  uint32_t first_;  // index of the frame's first path in the sequence
  Randomization kind_;
};

class PixelSampler {
 public:
  // `index`: which of the pixel's paths in the frame, from 0.
  PixelSampler(const PixelStream& stream, uint32_t x, uint32_t y, uint32_t index)
      : sobol_{mixWord(stream.key_ ^ (uint64_t{y} << 32 | x)), stream.kind_},
        index_(stream.first_ + index) {}

  float get1D(uint32_t dimension) const { return sobol_.get1D(index_, dimension, ~0u); }
  // Dimensions `dimension` (even) and `dimension + 1`.
  Vec2 get2D(uint32_t dimension) const { return sobol_.get2D(index_, dimension, ~0u); }

 private:
  PaddedSobol sobol_;
  uint32_t index_;
};

}  // namespace ninefold
