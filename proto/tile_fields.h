// tile_fields.h: the fields of a tile in the order in which they travel, for both directions, and
// the two coders that turn a field into byte planes and back. Internal to the tile codec. Threads:
// plain values, one per tile.
#pragma once

#include <array>

#include "common/image/layers.h"
#include "common/math/units.h"
#include "proto/bytes.h"
#include "proto/quantize.h"

namespace ninefold {

// Calls one of the coder's functions for each field that the tile's masks name.
template <typename Coder, typename Tile>
void forEachField(Coder& coder, Tile& tile) {
  for (int layer = 0; layer < kLayers; ++layer) {
    if (!hasLayer(tile.layerMask, layer)) continue;
    auto& planes = tile.layers[static_cast<size_t>(layer)];
    coder.fraction(planes.reflectance, kInvPi);
    coder.light(planes.irradiance);
    coder.light(planes.unfiltered);
    coder.length(planes.distance);
    coder.normal(planes.normal);
    coder.words(planes.chain);
  }
  auto& extras = tile.extras;
  if ((tile.extraMask & kAlbedoPlane) != 0) coder.fraction(extras.albedo, 1.0f);
  if ((tile.extraMask & kNormalPlane) != 0) coder.normal(extras.normal);
  if ((tile.extraMask & kDepthPlane) != 0) coder.length(extras.depth);
  if ((tile.extraMask & kObjectPlane) != 0) coder.words(extras.object);
  if ((tile.extraMask & kCausticPlane) != 0) coder.light(extras.caustic);
}

// Bytes that the fields of a tile take at most before zstd: what a peer may declare.
size_t mostFieldBytes(size_t pixels, uint8_t layerMask, uint8_t extraMask);

// Scratch for the bytes of one field: no value has more than four.
struct BytePlanes {
  std::array<std::vector<uint8_t>, 4> plane;
  void resize(size_t n) {
    for (auto& p : plane) p.resize(n);
  }
};

class FieldWriter {
 public:
  FieldWriter(int width, size_t pixels, uint64_t dither, BytePlanes& scratch, Bytes& out)
      : width_(static_cast<size_t>(width)),
        pixels_(pixels),
        dither_(dither),
        scratch_(scratch),
        out_(out) {
    scratch_.resize(pixels);
  }
  void fraction(const RgbPlane& values, float top);
  void light(const RgbPlane& values);
  void length(const std::vector<float>& values);
  void normal(const RgbPlane& values);
  void words(const std::vector<uint16_t>& values);
  void words(const std::vector<uint32_t>& values);

  uint64_t replaced() const { return replaced_; }

 private:
  Dither dither(size_t pixel) const {
    return Dither(dither_, field_, static_cast<uint32_t>(pixel));
  }
  float usable(float value);
  void flush(int planes);
  void flushZero(int planes);

  const size_t width_, pixels_;
  const uint64_t dither_;
  BytePlanes& scratch_;
  Bytes& out_;
  uint32_t field_ = 0;
  uint64_t replaced_ = 0;
};

class FieldReader {
 public:
  FieldReader(int width, size_t pixels, BytePlanes& scratch, ByteReader& in)
      : width_(static_cast<size_t>(width)), pixels_(pixels), scratch_(scratch), in_(in) {
    scratch_.resize(pixels);
  }
  void fraction(RgbPlane& values, float top);
  void light(RgbPlane& values);
  void length(std::vector<float>& values);
  void normal(RgbPlane& values);
  void words(std::vector<uint16_t>& values);
  void words(std::vector<uint32_t>& values);

 private:
  void fetch(int planes);

  const size_t width_, pixels_;
  BytePlanes& scratch_;
  ByteReader& in_;
};

}  // namespace ninefold
