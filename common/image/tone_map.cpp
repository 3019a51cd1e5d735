#include "common/image/tone_map.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "common/image/agx.h"

namespace ninefold {
namespace {

constexpr double kShoulder = 0.8;

// Table cells: floats from 2^kLowExponent to 2^kHighExponent, kMantissaBits of each binade. The
// ends are codes 0 and 255 at exposure 0; the exposure is applied before the look-up.
constexpr int kLowExponent = -14, kHighExponent = 3, kMantissaBits = 10;
constexpr int kShift = 23 - kMantissaBits;
constexpr uint32_t kFirstCell = uint32_t(127 + kLowExponent) << kMantissaBits;
constexpr uint32_t kCells = uint32_t(kHighExponent - kLowExponent) << kMantissaBits;

double rollOff(double x) {
  const double room = 1 - kShoulder;
  return x <= kShoulder ? x : kShoulder + room * (1 - std::exp(-(x - kShoulder) / room));
}

double filmic(double x) {
  constexpr double A = 0.15, B = 0.5, C = 0.1, D = 0.2, E = 0.02, F = 0.3, kWhite = 11.2;
  const auto h = [](double v) {
    return (v * (A * v + C * B) + D * E) / (v * (A * v + B) + D * F) - E / F;
  };
  return h(2 * x) / h(kWhite);
}

template <typename T>
T encoded(T y) {
  return y <= T(0.0031308) ? T(12.92) * y : T(1.055) * std::pow(y, 1 / T(2.4)) - T(0.055);
}

using Table = std::array<uint8_t, kCells>;

template <typename Curve>
Table makeTable(Curve curve) {
  Table codes;
  for (uint32_t cell = 0; cell < kCells; ++cell) {
    const uint32_t middle = ((kFirstCell + cell) << kShift) + (1u << (kShift - 1));
    const double code = encoded(curve(static_cast<double>(std::bit_cast<float>(middle))));
    codes[cell] = static_cast<uint8_t>(std::lround(255 * std::clamp(code, 0.0, 1.0)));
  }
  return codes;
}

const uint8_t* tableOf(ToneCurve curve) {
  if (curve == ToneCurve::agx) return nullptr;
  if (curve == ToneCurve::filmic) {
    static const Table codes = makeTable(filmic);
    return codes.data();
  }
  static const Table codes = makeTable(rollOff);
  return codes.data();
}

// A NaN is as black as what is too dark for the table. No branches, so that it becomes vectors.
uint32_t cellOf(float x) {
  constexpr float kLow = 1.0f / (1 << -kLowExponent);
  constexpr uint32_t kLast = kFirstCell + kCells - 1;
  const uint32_t bits = std::bit_cast<uint32_t>(x > kLow ? x : kLow) >> kShift;
  return (bits < kLast ? bits : kLast) - kFirstCell;
}

void markNan(const RgbPlane& radiance, size_t first, size_t pixels, uint8_t* rgb) {
  for (size_t i = 0; i < pixels; ++i) {
    const size_t p = first + i;
    if (std::isnan(radiance.r[p]) || std::isnan(radiance.g[p]) || std::isnan(radiance.b[p]))
      rgb[3 * i] = rgb[3 * i + 2] = 255, rgb[3 * i + 1] = 0;
  }
}

}  // namespace

float srgbFromLinear(float y) { return encoded(y); }

float linearFromSrgb(float code) {
  return code <= 0.04045f ? code / 12.92f : std::pow((code + 0.055f) / 1.055f, 2.4f);
}

ToneMap::ToneMap(const Tone& tone)
    : scale_(static_cast<float>(std::exp2(static_cast<double>(tone.exposure)))),
      table_(tableOf(tone.curve)) {}

ToneMap::Codes ToneMap::codes(Vec3 radiance) const {
  const Vec3 x = scale_ * radiance;
  if (table_ == nullptr) return agxCodes(x);
  return {table_[cellOf(x.x)], table_[cellOf(x.y)], table_[cellOf(x.z)]};
}

void ToneMap::apply(const RgbPlane& radiance, size_t first, size_t pixels, uint8_t* rgb) const {
  if (table_ != nullptr) return applyPerChannel(radiance, first, pixels, rgb);
  for (size_t i = 0; i < pixels; ++i) {
    const size_t p = first + i;
    const Codes code = codes(Vec3(radiance.r[p], radiance.g[p], radiance.b[p]));
    std::copy(code.begin(), code.end(), rgb + 3 * i);
  }
  markNan(radiance, first, pixels, rgb);
}

void ToneMap::applyPerChannel(const RgbPlane& radiance, size_t first, size_t pixels,
                              uint8_t* rgb) const {
  constexpr size_t kBlock = 64;
  uint32_t cells[3][kBlock];
  const uint8_t* const codes = table_;
  const float scale = scale_;
  uint32_t odd = 0;  // NaNs
  const float* planes[3] = {&radiance.r[first], &radiance.g[first], &radiance.b[first]};
  for (size_t begin = 0; begin < pixels; begin += kBlock) {
    const size_t count = std::min(kBlock, pixels - begin);
    for (size_t c = 0; c < 3; ++c) {
      const float* x = planes[c] + begin;
#pragma GCC ivdep
      for (size_t i = 0; i < count; ++i) {
        cells[c][i] = cellOf(scale * x[i]);
        odd |= x[i] == x[i] ? 0u : 1u;
      }
    }
    uint8_t* out = rgb + 3 * begin;
    for (size_t i = 0; i < count; ++i)
      for (size_t c = 0; c < 3; ++c) out[3 * i + c] = codes[cells[c][i]];
  }
  if (odd != 0) markNan(radiance, first, pixels, rgb);
}

void ToneMap::apply(const RgbImage& image, DisplayImage& out) const {
  out.reshape(image.width, image.height);
  if (image.count() > 0) apply(image.pixels, 0, image.count(), out.rgb.data());
}

}  // namespace ninefold
