#include "common/image/tone_map.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace ninefold {
namespace {

constexpr float kShoulder = 0.8f;

// Table cells: floats from 2^kLowExponent to 2^kHighExponent, kMantissaBits of each binade. The
// ends are codes 0 and 255 at exposure 0; the exposure is applied before the look-up.
constexpr int kLowExponent = -14, kHighExponent = 3, kMantissaBits = 10;
constexpr int kShift = 23 - kMantissaBits;
constexpr uint32_t kFirstCell = uint32_t(127 + kLowExponent) << kMantissaBits;
constexpr uint32_t kCells = uint32_t(kHighExponent - kLowExponent) << kMantissaBits;

float rollOff(float x) {
  const float room = 1 - kShoulder;
  return x <= kShoulder ? x : kShoulder + room * (1 - std::exp(-(x - kShoulder) / room));
}

}  // namespace

float srgbFromLinear(float y) {
  return y <= 0.0031308f ? 12.92f * y : 1.055f * std::pow(y, 1 / 2.4f) - 0.055f;
}

float linearFromSrgb(float code) {
  return code <= 0.04045f ? code / 12.92f : std::pow((code + 0.055f) / 1.055f, 2.4f);
}

ToneMap::ToneMap(float exposureEv) : scale_(std::exp2(exposureEv)), codes_(kCells) {
  for (uint32_t cell = 0; cell < kCells; ++cell) {
    const uint32_t middle = ((kFirstCell + cell) << kShift) + (1u << (kShift - 1));
    const float code = srgbFromLinear(rollOff(std::bit_cast<float>(middle)));
    codes_[cell] = static_cast<uint8_t>(std::lround(255 * std::clamp(code, 0.0f, 1.0f)));
  }
}

uint8_t ToneMap::code(float radiance) const {
  constexpr float kLow = 1.0f / (1 << -kLowExponent), kHigh = 1 << kHighExponent;
  const float x = scale_ * radiance;
  if (!(x >= kLow)) return codes_.front();
  if (x >= kHigh) return codes_.back();
  return codes_[(std::bit_cast<uint32_t>(x) >> kShift) - kFirstCell];
}

void ToneMap::apply(const RgbImage& image, std::vector<uint8_t>& rgb) const {
  const RgbPlane& p = image.pixels;
  rgb.resize(3 * image.count());
  for (size_t i = 0; i < image.count(); ++i) {
    const bool isNan = std::isnan(p.r[i]) || std::isnan(p.g[i]) || std::isnan(p.b[i]);
    rgb[3 * i] = isNan ? 255 : code(p.r[i]);
    rgb[3 * i + 1] = isNan ? 0 : code(p.g[i]);
    rgb[3 * i + 2] = isNan ? 255 : code(p.b[i]);
  }
}

}  // namespace ninefold
