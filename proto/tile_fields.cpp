#include "proto/tile_fields.h"

#include <limits>

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
  if (layerMask == 0) sizes.light({});  // radiance
  return sizes.planes * (1 + pixels) + sizes.scales * 8;
}

// --- writing ---

float FieldWriter::usable(float value) {
  if (value >= 0 && value <= std::numeric_limits<float>::max()) return value + 0.0f;  // -0 to 0
  ++replaced_;
  return 0;
}

void FieldWriter::flush(int planes) {
  for (int i = 0; i < planes; ++i)
    writePlane(scratch_.plane[static_cast<size_t>(i)], width_, differences_, out_);
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

void FieldOpener::open(int planes) {
  FieldView& field = fields_.emplace_back();
  field.constant = true;
  for (int i = 0; i < planes; ++i) {
    PlaneView& plane = field.plane[static_cast<size_t>(i)];
    plane = openPlane(in_, width_, pixels_);
    field.constant &= plane.bytes == nullptr;
  }
  if (field.constant) return;
  for (int i = 0; i < planes; ++i) {
    PlaneView& plane = field.plane[static_cast<size_t>(i)];
    if (plane.bytes == nullptr) plane.bytes = flat_.emplace_back(pixels_, plane.value).data();
  }
}

void FieldOpener::length(const std::vector<float>&) {
  const auto least = in_.number<uint32_t>("least length");
  const auto most = in_.number<uint32_t>("largest length");
  if (least > most || most >= kInfinityBits)
    fail("{}: range of lengths is no range; it is damaged", in_.what());
  open(2);
  fields_.back().least = least, fields_.back().most = most;
}

namespace {

struct Code {
  uint8_t a = 0, b = 0, c = 0, d = 0;
};

uint16_t word(uint8_t low, uint8_t high) { return static_cast<uint16_t>(low | high << 8); }

// store(i, decode(code of pixel i)) for the part's pixels; `planes` codes are read.
template <int planes, typename Decode, typename Store>
void forEachPixel(const FieldView& field, const TilePart& part, Decode decode, Store store) {
  const auto& p = field.plane;
  if (field.constant) {
    const auto value = decode(Code{p[0].value, p[1].value, p[2].value, p[3].value});
    for (int j = 0; j < part.height; ++j)
      for (int i = 0; i < part.width; ++i)
        store(part.to + static_cast<size_t>(j) * part.toStride + static_cast<size_t>(i), value);
    return;
  }
  for (int j = 0; j < part.height; ++j) {
    const size_t from = part.from + static_cast<size_t>(j) * part.fromStride;
    const size_t to = part.to + static_cast<size_t>(j) * part.toStride;
    const uint8_t *a = p[0].bytes + from, *b = p[1].bytes + from,
                  *c = planes > 2 ? p[2].bytes + from : a, *d = planes > 3 ? p[3].bytes + from : a;
#pragma GCC ivdep
    for (int i = 0; i < part.width; ++i)
      store(to + static_cast<size_t>(i), decode(Code{a[i], b[i], c[i], d[i]}));
  }
}

}  // namespace

void FieldCopier::fraction(RgbPlane& values, float top) {
  float *r = values.r.data(), *g = values.g.data(), *b = values.b.data();
  forEachPixel<3>(
      *next_++, part_,
      [top](Code c) {
        return Vec3(SquareCode::level(c.a, top), SquareCode::level(c.b, top),
                    SquareCode::level(c.c, top));
      },
      [=](size_t i, Vec3 v) { r[i] = v.x, g[i] = v.y, b[i] = v.z; });
}

void FieldCopier::light(RgbPlane& values) {
  float *r = values.r.data(), *g = values.g.data(), *b = values.b.data();
  forEachPixel<4>(
      *next_++, part_,
      [](Code c) {
        const float scale = SharedExponent::scaleOf(c.d);
        return Vec3(scale * static_cast<float>(c.a), scale * static_cast<float>(c.b),
                    scale * static_cast<float>(c.c));
      },
      [=](size_t i, Vec3 v) { r[i] = v.x, g[i] = v.y, b[i] = v.z; });
}

void FieldCopier::length(std::vector<float>& values) {
  float* out = values.data();
  const FloatSteps code(next_->least, next_->most);
  forEachPixel<2>(
      *next_++, part_, [&code](Code c) { return code.decode(word(c.a, c.b)); },
      [=](size_t i, float v) { out[i] = v; });
}

void FieldCopier::normal(RgbPlane& values) {
  float *r = values.r.data(), *g = values.g.data(), *b = values.b.data();
  forEachPixel<4>(
      *next_++, part_,
      [](Code c) {
        return Octahedral{word(c.a, c.b), word(c.c, c.d)}.decode();
      },
      [=](size_t i, Vec3 v) { r[i] = v.x, g[i] = v.y, b[i] = v.z; });
}

void FieldCopier::words(std::vector<uint16_t>& values) {
  uint16_t* out = values.data();
  forEachPixel<2>(
      *next_++, part_, [](Code c) { return word(c.a, c.b); },
      [=](size_t i, uint16_t v) { out[i] = v; });
}

void FieldCopier::words(std::vector<uint32_t>& values) {
  uint32_t* out = values.data();
  forEachPixel<4>(
      *next_++, part_,
      [](Code c) { return uint32_t{word(c.a, c.b)} | uint32_t{word(c.c, c.d)} << 16; },
      [=](size_t i, uint32_t v) { out[i] = v; });
}

}  // namespace ninefold
