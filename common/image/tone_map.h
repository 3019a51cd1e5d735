// tone_map.h: radiance to 8-bit sRGB for screens and PNG files.
//
//   x = 2^EV L,   y = x                                   for x <= a,   a = 0.8
//                 y = a + (1-a)(1 - exp(-(x-a)/(1-a)))    above: rolls off smoothly (C1) towards 1
//   code = round(255 OETF(y))       OETF of IEC 61966-2-1 (sRGB)
//
// per channel, no dithering: the same radiance always gives the same code. Negative values are
// black. A pixel with a NaN becomes magenta, so that it is seen. The curve is tabulated over the
// exponent and 10 bits of the mantissa, which costs at most one code.
//
// Proved:  tests/image/tone_map_test.cpp.   Threads: const, reentrant.
#pragma once

#include <cstdint>
#include <vector>

#include "common/image/image.h"

namespace ninefold {

// sRGB transfer curve and its inverse, on [0, 1].
float srgbFromLinear(float y);
float linearFromSrgb(float code);

class ToneMap {
 public:
  explicit ToneMap(float exposureEv = 0);

  uint8_t code(float radiance) const;
  // Interleaved R, G, B, row-major; sets the size of `rgb`.
  void apply(const RgbImage& image, std::vector<uint8_t>& rgb) const;

 private:
  float scale_;
  std::vector<uint8_t> codes_;
};

}  // namespace ninefold
