#include "proto/tile_fields.h"

#include <algorithm>
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

// Of a field that must not be negative, NaN or infinite.
bool isUsable(float value) {
  return bool(int(value >= 0) & int(value <= std::numeric_limits<float>::max()));
}
float usable(float value) { return isUsable(value) ? value + 0.0f : 0.0f; }  // -0 to 0
uint64_t unusable(const std::vector<float>& values) {
  uint32_t count = 0;
  for (const float value : values) count += isUsable(value) ? 0 : 1;
  return count;
}

}  // namespace

size_t mostFieldBytes(size_t pixels, uint8_t layerMask, uint8_t extraMask) {
  TileResult shape;
  shape.layerMask = layerMask, shape.extraMask = extraMask;
  FieldSizes sizes{pixels};
  forEachField(sizes, shape);
  if (layerMask == kRadianceMask) sizes.light({});
  if (layerMask == kDisplayMask) sizes.planes += 3;
  return sizes.planes * (1 + pixels) + sizes.scales * 8;
}

// --- writing ---

void FieldWriter::count(uint64_t replaced) {
  replaced_ += replaced;
  if (replaced > 0) replacedIn_ |= 1u << field_;
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
  const uint32_t key = fieldKey(), pixels = pixels_;
  const std::array planes = {values.r.data(), values.g.data(), values.b.data()};
  for (uint32_t c = 0; c < 3; ++c) {
    uint8_t* out = scratch_.plane[c].data();
    const float* in = planes[c];
#pragma GCC ivdep
    for (uint32_t i = 0; i < pixels; ++i) out[i] = code.encode(usable(in[i]), Dither(key, i)[c]);
  }
  count(unusable(values.r) + unusable(values.g) + unusable(values.b));
  flush(3);
}

void FieldWriter::light(const RgbPlane& values) {
  if (isZero(values)) return flushZero(4);
  const uint32_t key = fieldKey(), pixels = pixels_;
  uint8_t *r = scratch_.plane[0].data(), *g = scratch_.plane[1].data(),
          *b = scratch_.plane[2].data(), *e = scratch_.plane[3].data();
  const float *red = values.r.data(), *green = values.g.data(), *blue = values.b.data();
#pragma GCC ivdep
  for (uint32_t i = 0; i < pixels; ++i) {
    const SharedExponent code =
        SharedExponent::encode(usable(red[i]), usable(green[i]), usable(blue[i]), Dither(key, i));
    r[i] = code.r, g[i] = code.g, b[i] = code.b, e[i] = code.e;
  }
  count(unusable(values.r) + unusable(values.g) + unusable(values.b));
  flush(4);
}

void FieldWriter::length(const std::vector<float>& values) {
  // Bit patterns of positive floats are ordered as the floats are.
  uint32_t least = kInfinityBits, most = 0;
  for (const float value : values) {
    const auto bits = std::bit_cast<uint32_t>(value);
    const bool counts = bits - 1 < kInfinityBits - 1;  // negative floats have the top bit
    least = std::min(least, counts ? bits : kInfinityBits),
    most = std::max(most, counts ? bits : 0);
  }
  if (most == 0) least = 0;
  ByteWriter(out_).number(least);
  ByteWriter(out_).number(most);
  const FloatSteps code(least, most);
  const uint32_t key = fieldKey(), pixels = pixels_;
  uint8_t *low = scratch_.plane[0].data(), *high = scratch_.plane[1].data();
  const float* in = values.data();
#pragma GCC ivdep
  for (uint32_t i = 0; i < pixels; ++i) {
    const uint16_t word = code.encode(usable(in[i]), Dither(key, i)[0]);
    low[i] = static_cast<uint8_t>(word), high[i] = static_cast<uint8_t>(word >> 8);
  }
  count(unusable(values));
  flush(2);
}

void FieldWriter::normal(const RgbPlane& values) {
  uint8_t *xLow = scratch_.plane[0].data(), *xHigh = scratch_.plane[1].data(),
          *yLow = scratch_.plane[2].data(), *yHigh = scratch_.plane[3].data();
  const float *x = values.r.data(), *y = values.g.data(), *z = values.b.data();
  uint32_t replaced = 0;
  const uint32_t pixels = pixels_;
#pragma GCC ivdep
  for (uint32_t i = 0; i < pixels; ++i) {
    const float sum = std::abs(x[i]) + std::abs(y[i]) + std::abs(z[i]);
    replaced += sum <= std::numeric_limits<float>::max() ? 0 : 1;
    const Octahedral code = Octahedral::encode(Vec3(x[i], y[i], z[i]));
    xLow[i] = static_cast<uint8_t>(code.x), xHigh[i] = static_cast<uint8_t>(code.x >> 8);
    yLow[i] = static_cast<uint8_t>(code.y), yHigh[i] = static_cast<uint8_t>(code.y >> 8);
  }
  count(replaced);
  flush(4);
}

void FieldWriter::words(const std::vector<uint16_t>& values) {
  for (size_t k = 0; k < 2; ++k)
    std::transform(values.begin(), values.end(), scratch_.plane[k].begin(),
                   [k](uint16_t word) { return static_cast<uint8_t>(word >> (8 * k)); });
  flush(2);
}

void FieldWriter::words(const std::vector<uint32_t>& values) {
  for (size_t k = 0; k < 4; ++k)
    std::transform(values.begin(), values.end(), scratch_.plane[k].begin(),
                   [k](uint32_t word) { return static_cast<uint8_t>(word >> (8 * k)); });
  flush(4);
}

void FieldWriter::display(const RgbPlane& radiance, const ToneMap& toneMap) {
  for (size_t i = 0; i < radiance.r.size(); ++i) {
    const ToneMap::Codes codes =
        toneMap.codes(Vec3(usable(radiance.r[i]), usable(radiance.g[i]), usable(radiance.b[i])));
    for (size_t c = 0; c < 3; ++c) scratch_.plane[c][i] = codes[c];
  }
  for (const auto* plane : {&radiance.r, &radiance.g, &radiance.b}) count(unusable(*plane));
  flush(3);
}

// --- mending ---

void FieldMender::fieldDone(uint64_t replaced) {
  replaced_ += replaced;
  if (replaced > 0) replacedIn_ |= 1u << field_;
  ++field_;
}

void FieldMender::light(RgbPlane& values) {
  uint64_t replaced = 0;
  for (std::vector<float>* plane : {&values.r, &values.g, &values.b}) {
    replaced += unusable(*plane);
    for (float& value : *plane) value = usable(value);
  }
  fieldDone(replaced);
}

void FieldMender::length(std::vector<float>& values) {
  const uint64_t replaced = unusable(values);
  for (float& value : values) value = usable(value);
  fieldDone(replaced);
}

void FieldMender::normal(RgbPlane& values) {
  uint64_t replaced = 0;
  for (size_t i = 0; i < values.r.size(); ++i) {
    if (isFinite(Vec3(values.r[i], values.g[i], values.b[i]))) continue;
    values.r[i] = values.g[i] = values.b[i] = 0;
    ++replaced;
  }
  fieldDone(replaced);
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
  if (&values == leftOut_) return skip(1);
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

void FieldCopier::display(uint8_t* rgb) {
  forEachPixel<3>(
      *next_++, part_, [](Code c) { return c; },
      [rgb](size_t i, Code c) { rgb[3 * i] = c.a, rgb[3 * i + 1] = c.b, rgb[3 * i + 2] = c.c; });
}

}  // namespace ninefold
