// tile_fields.h: the fields of a tile in the order in which they travel, once for both directions,
// and the coders that turn a field into byte planes and back. Internal to the tile codec.
// Threads: plain values, one per tile.
#pragma once

#include <array>

#include "common/image/layers.h"
#include "common/image/tone_map.h"
#include "common/math/units.h"
#include "proto/byte_planes.h"
#include "proto/quantize.h"

namespace ninefold {

inline constexpr int kFieldsOfLayer = 6;

template <typename Coder, typename Planes>
void forEachFieldOfLayer(Coder& coder, Planes& planes) {
  coder.fraction(planes.reflectance, kInvPi);
  coder.light(planes.irradiance);
  coder.light(planes.unfiltered);
  coder.length(planes.distance);
  coder.normal(planes.normal);
  coder.words(planes.chain);
}

template <typename Coder, typename Tile>
void forEachExtraField(Coder& coder, Tile& tile) {
  auto& extras = tile.extras;
  if ((tile.extraMask & kAlbedoPlane) != 0) coder.fraction(extras.albedo, 1.0f);
  if ((tile.extraMask & kNormalPlane) != 0) coder.normal(extras.normal);
  if ((tile.extraMask & kDepthPlane) != 0) coder.length(extras.depth);
  if ((tile.extraMask & kObjectPlane) != 0) coder.words(extras.object);
  if ((tile.extraMask & kCausticPlane) != 0) coder.light(extras.caustic);
  if ((tile.extraMask & kIrradiancePlane) != 0) coder.light(extras.irradiance);
}

// Calls one of the coder's functions for each field that the tile's masks name.
template <typename Coder, typename Tile>
void forEachField(Coder& coder, Tile& tile) {
  for (int layer = 0; layer < kLayers; ++layer)
    if (hasLayer(tile.layerMask, layer))
      forEachFieldOfLayer(coder, tile.layers[static_cast<size_t>(layer)]);
  forEachExtraField(coder, tile);
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
  // `differences`: planes may be written as differences. That costs time and helps zstd only.
  FieldWriter(int width, size_t pixels, uint64_t dither, bool differences, BytePlanes& scratch,
              Bytes& out)
      : width_(static_cast<size_t>(width)),
        pixels_(static_cast<uint32_t>(pixels)),
        dither_(dither),
        differences_(differences),
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
  void display(const RgbPlane& radiance, const ToneMap& toneMap);

  uint64_t replaced() const { return replaced_; }
  uint32_t replacedIn() const { return replacedIn_; }  // bit i: in the i-th field

 private:
  uint32_t fieldKey() const { return Dither::fieldKey(dither_, field_); }
  void count(uint64_t replaced);
  void flush(int planes);
  void flushZero(int planes);

  const size_t width_;
  const uint32_t pixels_;
  const uint64_t dither_;
  const bool differences_;
  BytePlanes& scratch_;
  Bytes& out_;
  uint32_t field_ = 0;
  uint64_t replaced_ = 0;
  uint32_t replacedIn_ = 0;
};

// Sets values to 0 that FieldWriter would take for 0.
class FieldMender {
 public:
  void fraction(RgbPlane& values, float) { light(values); }
  void light(RgbPlane& values);
  void length(std::vector<float>& values);
  void normal(RgbPlane& values);
  void words(const std::vector<uint16_t>&) { ++field_; }
  void words(const std::vector<uint32_t>&) { ++field_; }

  uint64_t replaced() const { return replaced_; }
  uint32_t replacedIn() const { return replacedIn_; }

 private:
  void fieldDone(uint64_t replaced);

  uint32_t field_ = 0;
  uint64_t replaced_ = 0;
  uint32_t replacedIn_ = 0;
};

// A field where it lies in the tile's bytes: its planes, or one code for all pixels.
struct FieldView {
  std::array<PlaneView, 4> plane;
  bool constant = false;         // all planes are
  uint32_t least = 0, most = 0;  // lengths: range of the codes
  bool isZero() const {
    return constant && (plane[0].value | plane[1].value | plane[2].value | plane[3].value) == 0;
  }
};

// Finds a tile's fields in its bytes, in their order; undoes differences where they lie.
class FieldOpener {
 public:
  // `flat` gets the constant planes of fields that are not constant as a whole.
  FieldOpener(int width, size_t pixels, MutableReader& in, std::vector<FieldView>& fields,
              std::vector<std::vector<uint8_t>>& flat)
      : width_(static_cast<size_t>(width)),
        pixels_(pixels),
        in_(in),
        fields_(fields),
        flat_(flat) {}
  void fraction(const RgbPlane&, float) { open(3); }
  void light(const RgbPlane&) { open(4); }
  void length(const std::vector<float>&);
  void normal(const RgbPlane&) { open(4); }
  void words(const std::vector<uint16_t>&) { open(2); }
  void words(const std::vector<uint32_t>&) { open(4); }
  void display() { open(3); }

 private:
  void open(int planes);

  const size_t width_, pixels_;
  MutableReader& in_;
  std::vector<FieldView>& fields_;
  std::vector<std::vector<uint8_t>>& flat_;
};

// Part of a tile: `width` x `height` pixels that begin at pixel `from` of its rows of `fromStride`,
// to be written from pixel `to` on of rows of `toStride`.
struct TilePart {
  size_t from = 0, fromStride = 0, to = 0, toStride = 0;
  int width = 0, height = 0;
};

// Values of fields, in their order, into the planes of a tile or a patch.
class FieldCopier {
 public:
  FieldCopier(const FieldView* next, const TilePart& part) : next_(next), part_(part) {}
  void fraction(RgbPlane& values, float top);
  void light(RgbPlane& values);
  void length(std::vector<float>& values);
  void normal(RgbPlane& values);
  void words(std::vector<uint16_t>& values);
  void words(std::vector<uint32_t>& values);
  void display(uint8_t* rgb);  // three bytes a pixel

  void skip(int fields) { next_ += fields; }
  void leaveOut(const RgbPlane* light) { leftOut_ = light; }  // null: nothing

 private:
  const FieldView* next_;
  const RgbPlane* leftOut_ = nullptr;
  const TilePart part_;
};

}  // namespace ninefold
