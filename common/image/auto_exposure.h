// auto_exposure.h: the exposure [EV] that suits a picture by itself.
//
//   EV = log2(a / exp(mean of log L)), rounded to tenths     a = kMiddleGrey
//                                                            L: luminance of a pixel
//
// So the picture's log-average is shown as middle grey. Pixels that are black, or no finite number,
// do not count: a background without light tells nothing. EV is held to +-kMostExposure, and 0 for
// a picture of such pixels alone. The same picture always has the same exposure.
//
// Source:  Reinhard et al. 2002, the key of a scene.
// Fails:   a picture that is meant to be dark or bright is shown like any other.
// Proved:  tests/image/auto_exposure_test.cpp.   Threads: pure.   Errors: none.
#pragma once

#include "common/image/image.h"

namespace ninefold {

inline constexpr double kMiddleGrey = 0.18;

float autoExposure(const RgbImage& radiance);

}  // namespace ninefold
