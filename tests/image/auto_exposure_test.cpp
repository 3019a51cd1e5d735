// The exposure that a picture asks for. Expected: log2(0.5 / L), to tenths, where 90 % of the
// pixels have a luminance below L.
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

TEST(AutoExposure, ShowsAnEvenPictureAtHalfOfWhite) {
  EXPECT_FLOAT_EQ(autoExposure(grey({0.5f, 0.5f})), 0);
  EXPECT_FLOAT_EQ(autoExposure(grey({0.25f, 0.25f})), 1);
  EXPECT_FLOAT_EQ(autoExposure(grey({4})), -3);
  EXPECT_FLOAT_EQ(autoExposure(grey({0.8f})), -0.7f) << "log2(0.5 / 0.8) = -0.68";
}

TEST(AutoExposure, ATenthOfThePictureMayBurn) {
  // The tenth of eleven values is at rank 9 of 0 to 10.
  EXPECT_FLOAT_EQ(autoExposure(grey({1, 1, 1, 1, 1, 1, 1, 1, 1, 2, 5000})), -2);
  const float dim = 0.0625f;
  EXPECT_FLOAT_EQ(autoExposure(grey({5000, dim, dim, dim, dim, dim, dim, dim, dim, dim, dim})), 3)
      << "in any order";
}

TEST(AutoExposure, WhatIsBlackOrNoNumberDoesNotCount) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FLOAT_EQ(autoExposure(grey({0, 0, 0, 0, 0, 0.5f, nan})), 0);
  EXPECT_EQ(autoExposure(grey({0, 0})), 0);
  EXPECT_EQ(autoExposure(grey({nan})), 0);
  EXPECT_EQ(autoExposure(RgbImage{}), 0);
}

}  // namespace
}  // namespace ninefold
