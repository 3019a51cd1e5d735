// tone_map.h: radiance to 8-bit sRGB for screens and PNG files.
//
//   x = 2^EV L;   OETF of IEC 61966-2-1 (sRGB);   code = round(255 z), z held to 0 ... 1
//
//   srgb    y = x for x <= a, a = 0.8; above a + (1-a)(1 - exp(-(x-a)/(1-a))): rolls off smoothly
//           (C1) towards 1.   z = OETF(y).   Colours as they are: the default.
//   filmic  y = h(2x)/h(11.2),   h(x) = (x(Ax+CB)+DE)/(x(Ax+B)+DF) - E/F,   z = OETF(y)
//           A 0.15, B 0.5, C 0.1, D 0.2, E 0.02, F 0.3.   Source: Hable 2010 (Uncharted 2).
//   agx     v = M (R,G,B);   t = (log2 v + 12.47393)/16.5, held to 0 ... 1
//           c = 15.5t^6 - 40.14t^5 + 31.96t^4 - 6.868t^3 + 0.4298t^2 + 0.1191t - 0.00232
//           z = M' (c), M' the inverse of AgX's outset: strong light turns white instead of
//           clipping to a hue.   Source: AgX of T. Sobotka (2022), base look; B. Wrensch's fit of
//           its curve and matrices (2023).
//
// srgb and filmic go per channel. No dithering: the same radiance always gives the same code.
// Negative values are black. A pixel with a NaN becomes magenta, so that it is seen.
//
// Curves are tabulated over the exponent and 10 bits of the mantissa, which costs at most one code.
// Tables are the same on every machine: no code of srgb or filmic lies nearer to the next one than
// mathematical libraries may differ by, and agx's c is rounded to 2^-16.
//
// Proved:  tests/image/tone_map_test.cpp.   Threads: const, reentrant.
#pragma once

#include <array>
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

enum class ToneCurve : uint8_t { srgb, filmic, agx };
inline constexpr std::array kToneCurveNames = {"srgb", "filmic", "agx"};

struct Tone {
  float exposure = 0;  // [EV] in [-kMostExposure, kMostExposure]
  ToneCurve curve = ToneCurve::srgb;
  bool operator==(const Tone&) const = default;
};

class ToneMap {
 public:
  explicit ToneMap(const Tone& tone);
  explicit ToneMap(float exposureEv = 0) : ToneMap(Tone{exposureEv}) {}

  using Codes = std::array<uint8_t, 3>;
  Codes codes(Vec3 radiance) const;
  uint8_t code(float grey) const { return codes(Vec3(grey))[0]; }
  // Writes `pixels` pixels from `first` on, three codes each.
  void apply(const RgbPlane& radiance, size_t first, size_t pixels, uint8_t* rgb) const;
  // Sets the shape of `out`.
  void apply(const RgbImage& image, DisplayImage& out) const;

 private:
  void applyPerChannel(const RgbPlane& radiance, size_t first, size_t pixels, uint8_t* rgb) const;

  float scale_;
  const uint8_t* table_;  // of all tone maps of this curve; null: agx
};

}  // namespace ninefold
