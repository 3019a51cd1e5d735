// tile_codec.h: a task's planes to few bytes and back. The format is in PROTOCOL.md.
//
//   field                          code                                   |decoded - value| at most
//   reflectance in [0, 1/pi]       8 bit, levels (q/255)^2 / pi           (2 sqrt(t) + 1/255)/(255
//   pi), t = pi value albedo in [0, 1]               8 bit, levels (q/255)^2                (2
//   sqrt(t) + 1/255)/255,      t = value E, U, caustic >= 0             8:8:8:8, common exponent
//   max(r, g, b)/127.5, or 2^-134 if larger distance, depth > 0            16 bit between the
//   tile's min and max  value * ceil(D/65534) 2^-23, where D
//                                  of float bit patterns (a stepwise      is the distance of max
//                                  and min in logarithm); 0 stays exactly 0          floats;
//                                  max/min = 2^k gives k/65534
//   normals, unit                  octahedral 2 x 16 bit; 0 stays 0       6.5e-5 rad
//   chain, object                  as they are                            0
//
// Rounding is stochastic between the two neighbouring *decoded* levels, so that the mean over
// dithers is the value itself: quantization never biases a film. (Normals round to nearest: they
// steer a filter, are not summed.) The dither is a hash of (dither key, field, pixel), so that a
// task that is repeated anywhere gives the same bytes. No transcendental functions: the code is the
// same on every machine. E, U range over all floats up to 3.39e38 (larger ones are clamped to it);
// values that are not finite, or negative, are replaced by 0 and counted.
//
// Owner: one encoder or decoder per thread (they keep compression state between tiles).
// Errors: encode CHECKs its limits; decode throws Error on anything malformed, before it allocates.
#pragma once

#include <memory>

#include "common/image/layers.h"
#include "common/scene/settings.h"
#include "proto/bytes.h"

namespace ninefold {

inline constexpr int kMaxTilePixels = 1 << 14;

// What a decoder must find; everything follows from the task and the scene's needs.
struct TileShape {
  int width = 0, height = 0;  // width * height <= kMaxTilePixels; both 0 for an empty task
  uint8_t layerMask = kDiffuseBit;
  uint8_t extraMask = 0;
};

// The dither key of a task: stands still while the picture moves, like all randomness.
uint64_t ditherKey(uint64_t seed, const FrameKey& frame, uint32_t tile, uint32_t phase);

class TileEncoder {
 public:
  TileEncoder();
  ~TileEncoder();

  struct Encoded {
    Bytes bytes;            // at most kMaxTileBytes (messages.h)
    uint64_t replaced = 0;  // values that were not finite or negative
  };
  // level: zstd's (1 is the default of the program); 0 stores the planes uncompressed.
  Encoded encode(const TileResult& tile, uint64_t dither, int level);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

class TileDecoder {
 public:
  TileDecoder();
  ~TileDecoder();

  // Fills `out` (its ray counts become zero: they travel in the message). Throws Error and leaves
  // `out` in any state if the bytes are not exactly one tile of this shape.
  void decode(ByteView bytes, const TileShape& expected, TileResult& out);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ninefold
