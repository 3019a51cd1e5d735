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

#include "common/image/image.h"
#include "common/image/tone_map.h"
#include "common/scene/settings.h"
#include "proto/bytes.h"
#include "proto/tile_fields.h"

namespace ninefold {

inline constexpr int kMaxTilePixels = 1 << 14;

// What a decoder must find; everything follows from the task and the scene's needs. kRadianceMask
// or kDisplayMask instead of layers: the tile's finished pixels.
struct TileShape {
  int width = 0, height = 0;  // width * height <= kMaxTilePixels; both 0 for an empty task
  uint8_t layerMask = kDiffuseBit;
  uint8_t extraMask = 0;
};

// The dither key of a task: stands still while the picture moves, like all randomness.
uint64_t ditherKey(uint64_t seed, const FrameKey& frame, uint32_t tile, uint32_t phase);

// Values that were not finite, or negative where nothing is, and became 0.
struct Replaced {
  uint64_t count = 0;
  uint32_t fields = 0;  // they were in (tile_names.h)
  Replaced& operator+=(const Replaced& more) {
    count += more.count, fields |= more.fields;
    return *this;
  }
};
// What encoding does to such values, for who looks at the tile before.
Replaced replaceUnusable(TileResult& tile);

class TileEncoder {
 public:
  TileEncoder();
  ~TileEncoder();

  struct Encoded {
    Bytes bytes;          // at most kMaxTileBytes (messages.h)
    size_t rawBytes = 0;  // at level 0
    Replaced replaced;
  };
  // level: zstd's; 0 stores the planes uncompressed. What is decoded does not depend on it.
  Encoded encode(const TileResult& tile, uint64_t dither, int level);
  // A tile's finished radiance, as one field of light.
  Encoded encode(const RgbImage& radiance, uint64_t dither, int level);
  // The same as a display takes it: exactly the tone map's codes of what is finite and not
  // negative. Master-mapped, the field of light above gives codes of a radiance that is off by its
  // own bound.
  Encoded encode(const RgbImage& radiance, const ToneMap& toneMap, int level);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// A task's result, unpacked but not yet decoded: about as many bytes as its codes have. Parts of it
// can be decoded where they are needed, at any time.
class UnpackedTile {
 public:
  UnpackedTile() = default;
  UnpackedTile(UnpackedTile&&) = default;
  UnpackedTile& operator=(UnpackedTile&&) = default;

  int width() const { return width_; }
  int height() const { return height_; }
  size_t bytes() const { return bytes_.size(); }
  // Layers that have reflectance, E or U anywhere; those that have U.
  uint8_t bright() const { return bright_; }
  uint8_t glowing() const { return glowing_; }

  // Decodes a part of some layers, and of all extra planes, into the planes of `out`, which has the
  // same layers and extras; U only of those that glow. Rows of `out` hold `stride` pixels.
  struct Part {
    int fromI = 0, fromJ = 0;  // first pixel in the tile
    int to = 0;                // its index in out's planes
    int width = 0, height = 0;
  };
  void copy(const Part& part, uint8_t layers, uint8_t glowing, int stride, TileResult& out) const;
  // Asks the memory for what copy() will read.
  void prefetch() const;
  // All of a tile of radiance; sets the shape of `out`.
  void copyRadiance(RgbImage& out) const;
  // All of a tile of codes, R, G, B of each pixel; rows of `out` hold `stride` pixels.
  void copyDisplay(size_t stride, uint8_t* out) const;

 private:
  friend class TileDecoder;
  void findLight();
  int width_ = 0, height_ = 0;
  Bytes bytes_;                             // what the fields' planes point into
  std::vector<std::vector<uint8_t>> flat_;  // and these
  std::vector<FieldView> fields_;
  uint8_t layerMask_ = 0, bright_ = 0, glowing_ = 0;
};

class TileDecoder {
 public:
  TileDecoder();
  ~TileDecoder();

  // Takes the bytes apart: decompresses, checks, finds the fields. Throws Error if the bytes are
  // not exactly one tile of this shape.
  UnpackedTile unpack(Bytes&& bytes, const TileShape& expected);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ninefold
