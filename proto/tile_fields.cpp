#include "proto/tile_fields.h"

#include <limits>

#include "proto/byte_planes.h"

namespace ninefold {
namespace {

constexpr uint32_t kInfinityBits = 0x7f800000;

struct FieldSizes {
  size_t pixels;
  size_t planes = 0, scales = 0;
  void fraction(const RgbPlane&, float) { planes += 3; }
  void light(const RgbPlane&) { planes += 4; }
  void length(const std::vector<float>&) { planes += 2, ++scales; }
  void normal(const RgbPlane&) { planes += 4; }
  void words(const std::vector<uint16_t>&) { planes += 2; }
  void words(const std::vector<uint32_t>&) { planes += 4; }
};

// Most tiles have no light in most layers; all bits are looked at, so that NaN and -0 are not zero.
bool isZero(const std::vector<float>& values) {
  uint32_t bits = 0;
  for (const float value : values) bits |= std::bit_cast<uint32_t>(value);
  return bits == 0;
}
bool isZero(const RgbPlane& values) {
  return isZero(values.r) && isZero(values.g) && isZero(values.b);
}

}  // namespace

size_t mostFieldBytes(size_t pixels, uint8_t layerMask, uint8_t extraMask) {
  TileResult shape;
  shape.layerMask = layerMask, shape.extraMask = extraMask;
  FieldSizes sizes{pixels};
  forEachField(sizes, shape);
  return sizes.planes * (1 + pixels) + sizes.scales * 8;
}

// --- writing ---

float FieldWriter::usable(float value) {
  if (value >= 0 && value <= std::numeric_limits<float>::max()) return value + 0.0f;  // -0 to 0
  ++replaced_;
  return 0;
}

void FieldWriter::flush(int planes) {
  for (int i = 0; i < planes; ++i) writePlane(scratch_.plane[static_cast<size_t>(i)], width_, out_);
  ++field_;
}

void FieldWriter::flushZero(int planes) {
  for (int i = 0; i < planes; ++i) writeZeroPlane(out_);
  ++field_;
}

void FieldWriter::fraction(const RgbPlane& values, float top) {
  if (isZero(values)) return flushZero(3);
  const SquareCode code(top);
  auto& [r, g, b, unused] = scratch_.plane;
  for (size_t i = 0; i < pixels_; ++i) {
    const Dither u = dither(i);
    r[i] = code.encode(usable(values.r[i]), u[0]);
    g[i] = code.encode(usable(values.g[i]), u[1]);
    b[i] = code.encode(usable(values.b[i]), u[2]);
  }
  flush(3);
}

void FieldWriter::light(const RgbPlane& values) {
  if (isZero(values)) return flushZero(4);
  auto& [r, g, b, e] = scratch_.plane;
  for (size_t i = 0; i < pixels_; ++i) {
    const SharedExponent code = SharedExponent::encode(usable(values.r[i]), usable(values.g[i]),
                                                       usable(values.b[i]), dither(i));
    r[i] = code.r, g[i] = code.g, b[i] = code.b, e[i] = code.e;
  }
  flush(4);
}

void FieldWriter::length(const std::vector<float>& values) {
  // Bit patterns of positive floats are ordered as the floats are.
  uint32_t least = kInfinityBits, most = 0;
  for (const float value : values) {
    const auto bits = std::bit_cast<uint32_t>(value);
    if (bits == 0 || bits >= kInfinityBits) continue;  // negative floats have the top bit
    least = std::min(least, bits), most = std::max(most, bits);
  }
  if (most == 0) least = 0;
  ByteWriter(out_).number(least);
  ByteWriter(out_).number(most);
  const FloatSteps code(least, most);
  auto& [low, high, unused1, unused2] = scratch_.plane;
  for (size_t i = 0; i < pixels_; ++i) {
    const uint16_t word = code.encode(usable(values[i]), dither(i)[0]);
    low[i] = static_cast<uint8_t>(word), high[i] = static_cast<uint8_t>(word >> 8);
  }
  flush(2);
}

void FieldWriter::normal(const RgbPlane& values) {
  auto& [xLow, xHigh, yLow, yHigh] = scratch_.plane;
  for (size_t i = 0; i < pixels_; ++i) {
    Vec3 n(values.r[i], values.g[i], values.b[i]);
    if (!isFinite(n)) ++replaced_, n = Vec3(0);
    const Octahedral code = Octahedral::encode(n);
    xLow[i] = static_cast<uint8_t>(code.x), xHigh[i] = static_cast<uint8_t>(code.x >> 8);
    yLow[i] = static_cast<uint8_t>(code.y), yHigh[i] = static_cast<uint8_t>(code.y >> 8);
  }
  flush(4);
}

void FieldWriter::words(const std::vector<uint16_t>& values) {
  for (size_t i = 0; i < pixels_; ++i)
    for (size_t k = 0; k < 2; ++k)
      scratch_.plane[k][i] = static_cast<uint8_t>(values[i] >> (8 * k));
  flush(2);
}

void FieldWriter::words(const std::vector<uint32_t>& values) {
  for (size_t i = 0; i < pixels_; ++i)
    for (size_t k = 0; k < 4; ++k)
      scratch_.plane[k][i] = static_cast<uint8_t>(values[i] >> (8 * k));
  flush(4);
}

// --- reading ---

namespace {

uint16_t word(uint8_t low, uint8_t high) { return static_cast<uint16_t>(low | high << 8); }

}  // namespace

void FieldReader::fetch(int planes) {
  for (int i = 0; i < planes; ++i) readPlane(in_, width_, scratch_.plane[static_cast<size_t>(i)]);
}

void FieldReader::fraction(RgbPlane& values, float top) {
  fetch(3);
  const SquareCode code(top);
  const auto& [r, g, b, unused] = scratch_.plane;
  for (size_t i = 0; i < pixels_; ++i) values.r[i] = code.decode(r[i]);
  for (size_t i = 0; i < pixels_; ++i) values.g[i] = code.decode(g[i]);
  for (size_t i = 0; i < pixels_; ++i) values.b[i] = code.decode(b[i]);
}

void FieldReader::light(RgbPlane& values) {
  fetch(4);
  const auto& [r, g, b, e] = scratch_.plane;
  for (size_t i = 0; i < pixels_; ++i) {
    const float scale = SharedExponent::scaleOf(e[i]);
    values.r[i] = scale * static_cast<float>(r[i]);
    values.g[i] = scale * static_cast<float>(g[i]);
    values.b[i] = scale * static_cast<float>(b[i]);
  }
}

void FieldReader::length(std::vector<float>& values) {
  const auto least = in_.number<uint32_t>("least length");
  const auto most = in_.number<uint32_t>("largest length");
  if (least > most || most >= kInfinityBits)
    fail("{}: range of lengths is no range; it is damaged", in_.what());
  fetch(2);
  const FloatSteps code(least, most);
  const auto& [low, high, unused1, unused2] = scratch_.plane;
  for (size_t i = 0; i < pixels_; ++i) values[i] = code.decode(word(low[i], high[i]));
}

void FieldReader::normal(RgbPlane& values) {
  fetch(4);
  const auto& [xLow, xHigh, yLow, yHigh] = scratch_.plane;
  for (size_t i = 0; i < pixels_; ++i) {
    const Vec3 n = Octahedral{word(xLow[i], xHigh[i]), word(yLow[i], yHigh[i])}.decode();
    values.r[i] = n.x, values.g[i] = n.y, values.b[i] = n.z;
  }
}

void FieldReader::words(std::vector<uint16_t>& values) {
  fetch(2);
  for (size_t i = 0; i < pixels_; ++i) values[i] = word(scratch_.plane[0][i], scratch_.plane[1][i]);
}

void FieldReader::words(std::vector<uint32_t>& values) {
  fetch(4);
  const auto& [a, b, c, d] = scratch_.plane;
  for (size_t i = 0; i < pixels_; ++i)
    values[i] = uint32_t{word(a[i], b[i])} | uint32_t{word(c[i], d[i])} << 16;
}

}  // namespace ninefold
