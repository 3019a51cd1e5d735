// tone_map.h: radiance to 8-bit sRGB for screens and PNG files.
//
//   x = 2^EV L,   y = x                                   for x <= a,   a = 0.8
//                 y = a + (1-a)(1 - exp(-(x-a)/(1-a)))    above: rolls off smoothly (C1) towards 1
//   code = round(255 OETF(y))       OETF of IEC 61966-2-1 (sRGB)
//
// per channel, no dithering: the same radiance always gives the same code. Negative values are
// black. A pixel with a NaN becomes magenta, so that it is seen.
//
// The curve is tabulated over the exponent and 10 bits of the mantissa, which costs at most one
// code. The table is the same on every machine: no entry lies nearer to the next code than
// mathematical libraries may differ by.
//
// Proved:  tests/image/tone_map_test.cpp.   Threads: const, reentrant.
#pragma once

#include <cstdint>
#include <vector>

#include "common/image/image.h"

namespace ninefold {

// A picture as a screen or a PNG takes it: codes R, G, B of each pixel, row-major.
struct DisplayImage {
  int width = 0, height = 0;
  std::vector<uint8_t> rgb;

  // Sets the shape; old values may stay.
  void reshape(int w, int h) {
    width = w, height = h;
    rgb.resize(3 * pixelCount(w, h));
  }
  bool empty() const { return rgb.empty(); }
  bool operator==(const DisplayImage&) const = default;
};

// sRGB transfer curve and its inverse, on [0, 1].
float srgbFromLinear(float y);
float linearFromSrgb(float code);

inline constexpr float kMostExposure = 50;  // [EV], and its negative

class ToneMap {
 public:
  // Exposure [EV] in [-kMostExposure, kMostExposure].
  explicit ToneMap(float exposureEv = 0);

  uint8_t code(float radiance) const;
  // Writes `pixels` pixels from `first` on, three codes each.
  void apply(const RgbPlane& radiance, size_t first, size_t pixels, uint8_t* rgb) const;
  // Sets the shape of `out`.
  void apply(const RgbImage& image, DisplayImage& out) const;

 private:
  float scale_;
  const uint8_t* codes_;  // of all tone maps
};

}  // namespace ninefold
