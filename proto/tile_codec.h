// tile_codec.h: a task's planes to few bytes and back. The format is in PROTOCOL.md.
//
//   field                      code                           |decoded - value| at most
//   reflectance in [0, 1/pi]   8 bit, levels (q/255)^2 / pi   (2 sqrt(t) + 1/255)/255/pi, t = pi v
//   albedo in [0, 1]           8 bit, levels (q/255)^2        (2 sqrt(t) + 1/255)/255,    t = v
//   E, U, caustic >= 0         8:8:8:8, a common exponent     max(r, g, b)/127.5, at least 2^-134
//   distance, depth > 0        16 bit, even steps of the      v ceil(D/65534) 2^-23, D floats from
//                              floats' bits from the tile's   min to max; max/min = 2^k gives
//                              min to its max; 0 stays 0      about v k/65534
//   normal, unit               octahedral, 2 x 16 bit         6.5e-5 rad; 0 stays 0
//   chain, object              as they are                    0
//
// v is the value. Rounding is stochastic, between the two neighbouring *decoded* levels, and v its
// mean: quantization never biases a film. (Normals round to nearest: they steer a filter and are
// not summed.) The dither is a hash of (dither key, field, pixel): a task that is repeated anywhere
// gives the same bytes. No transcendental functions: the code is the same on every machine. E and U
// go up to 3.39e38; larger ones become that. Values that are not finite, or negative, become 0 and
// are counted.
//
// Owner: one encoder or decoder per thread (they keep compression state between tiles).
// Errors: encode CHECKs its limits; decode throws Error on anything malformed, before it allocates.
#pragma once

#include <memory>

#include "common/image/image.h"
#include "common/image/tone_map.h"
#include "common/scene/settings.h"
#include "proto/bytes.h"
#include "proto/sha256.h"
#include "proto/tile_fields.h"

namespace ninefold {

inline constexpr int kMaxTilePixels = 1 << 14;

// What a decoder must find, as the task and the scene's needs say. layerMask kRadianceMask or
// kDisplayMask: the tile's finished pixels instead of layers.
struct TileShape {
  int width = 0, height = 0;  // width * height <= kMaxTilePixels; both 0 for an empty task
  uint8_t layerMask = kDiffuseBit;
  uint8_t extraMask = 0;
};

// The dither key of a task. It is the same in all frames of a gesture, as all randomness is.
uint64_t ditherKey(uint64_t seed, const FrameKey& frame, uint32_t tile, uint32_t phase);

// Values that became 0: they were not finite, or negative where nothing can be.
struct Replaced {
  uint64_t count = 0;
  uint32_t fields = 0;  // they were in (tile_names.h)
  Replaced& operator+=(const Replaced& more) {
    count += more.count, fields |= more.fields;
    return *this;
  }
};
// Does to such values what encoding does, for whoever filters the tile before.
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
  // The same as a display's codes, exactly the tone map's. (A master that maps the radiance above
  // maps a rounded one.)
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

  // Of all codes: equal for tiles that decode to the same, whatever the level of compression.
  Sha256 digest() const;

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
