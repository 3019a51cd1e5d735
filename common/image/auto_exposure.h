// auto_exposure.h: the exposure [EV] that suits a picture by itself.
//
//   EV = log2(a / L)      L: luminance that kShare of the pixels that are not black stay below, a = kBright
//
// rounded to tenths. From kBright (code 188) to where the tone map's curve begins to bend there are
// two thirds of a stop left for what is brighter; lamps are rolled off. 0 for a picture that is
// black or has values that are not finite in L's place. The same picture always has the same
// exposure. Fails: a picture that is lamps for more than 1 - kShare is made too dark.
//
// Proved: tests/image/auto_exposure_test.cpp. Threads: pure. Errors: none.
#pragma once

#include "common/image/image.h"

namespace ninefold {

inline constexpr double kShare = 0.9, kBright = 0.5;

float autoExposure(const RgbImage& radiance);

}  // namespace ninefold
