// auto_exposure.h: the exposure [EV] that suits a picture by itself.
//
//   EV = log2(a / L), rounded to tenths     a = kBright; L: luminance that kShare of the pixels
//                                           that are not black stay below
//
// From kBright (code 188) to the bend of the tone map's curve two thirds of a stop are left for
// what is brighter; lamps are rolled off. EV is 0 for a picture that is black or has no finite L.
// The same picture always has the same exposure.
//
// Fails:   a picture that is lamps for more than 1 - kShare is made too dark.
// Proved:  tests/image/auto_exposure_test.cpp.   Threads: pure.   Errors: none.
#pragma once

#include "common/image/image.h"

namespace ninefold {

inline constexpr double kShare = 0.9, kBright = 0.5;

float autoExposure(const RgbImage& radiance);

}  // namespace ninefold
