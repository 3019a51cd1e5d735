// The exposure that a picture asks for. Expected: log2(0.8 / L), to tenths, L the luminance that 90 % stay below.
#include "common/image/auto_exposure.h"

#include <gtest/gtest.h>

#include <limits>

namespace ninefold {
namespace {

RgbImage grey(std::initializer_list<float> values) {
  RgbImage image;
  image.reset(static_cast<int>(values.size()), 1);
  size_t i = 0;
  for (const float v : values) image.pixels.r[i] = image.pixels.g[i] = image.pixels.b[i] = v, ++i;
  return image;
}

TEST(AutoExposure, ShowsAnEvenPictureWhereTheCurveBegins) {
  EXPECT_FLOAT_EQ(autoExposure(grey({0.8f, 0.8f})), 0);
  EXPECT_FLOAT_EQ(autoExposure(grey({0.4f, 0.4f})), 1);
  EXPECT_FLOAT_EQ(autoExposure(grey({6.4f})), -3);
  EXPECT_FLOAT_EQ(autoExposure(grey({1})), -0.3f) << "log2(0.8) = -0.32";
}

TEST(AutoExposure, ATenthOfThePictureMayBurn) {
  // The tenth of eleven values is at rank 9 of 0 to 10.
  EXPECT_FLOAT_EQ(autoExposure(grey({1, 1, 1, 1, 1, 1, 1, 1, 1, 3.2f, 5000})), -2);
  EXPECT_FLOAT_EQ(autoExposure(grey({5000, 0.1f, 0.1f, 0.1f, 0.1f, 0.1f, 0.1f, 0.1f, 0.1f, 0.1f, 0.1f})),
                  3) << "in any order";
}

TEST(AutoExposure, WhatIsBlackOrNoNumberDoesNotCount) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FLOAT_EQ(autoExposure(grey({0, 0, 0, 0, 0, 0.8f, nan})), 0);
  EXPECT_EQ(autoExposure(grey({0, 0})), 0);
  EXPECT_EQ(autoExposure(grey({nan})), 0);
  EXPECT_EQ(autoExposure(RgbImage{}), 0);
}

}  // namespace
}  // namespace ninefold
