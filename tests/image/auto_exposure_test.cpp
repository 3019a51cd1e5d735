// The exposure that a picture asks for. Expected: log2(0.18 / L), to tenths, L the geometric mean
// of the luminance of all pixels that are not black.
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

TEST(AutoExposure, ShowsAnEvenPictureAsMiddleGrey) {
  EXPECT_FLOAT_EQ(autoExposure(grey({0.18f, 0.18f})), 0);
  EXPECT_FLOAT_EQ(autoExposure(grey({0.09f, 0.09f})), 1);
  EXPECT_FLOAT_EQ(autoExposure(grey({1.44f})), -3);
  EXPECT_FLOAT_EQ(autoExposure(grey({54351})), -18.2f) << "log2(0.18 / 54351) = -18.20";
}

TEST(AutoExposure, TakesTheGeometricMean) {
  EXPECT_FLOAT_EQ(autoExposure(grey({0.09f, 0.36f})), 0);
  EXPECT_FLOAT_EQ(autoExposure(grey({0.18f, 0.18f, 0.18f, 0.18f * 16})), -1);
}

TEST(AutoExposure, ALampInThePictureCountsForLittle) {
  RgbImage image = grey({0.18f});
  image.reset(100, 10);
  for (auto* plane : {&image.pixels.r, &image.pixels.g, &image.pixels.b})
    for (size_t i = 0; i < plane->size(); ++i) (*plane)[i] = i == 5 ? 1e6f : 0.18f;
  EXPECT_FLOAT_EQ(autoExposure(image), 0) << "22 stops over 1000 pixels";
}

TEST(AutoExposure, WhatIsBlackOrNoNumberDoesNotCount) {
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              inf = std::numeric_limits<float>::infinity();
  EXPECT_FLOAT_EQ(autoExposure(grey({0, 0, 0, 0, 0, 0.18f, nan, inf, -1})), 0);
  EXPECT_EQ(autoExposure(grey({0, 0})), 0);
  EXPECT_EQ(autoExposure(grey({nan})), 0);
  EXPECT_EQ(autoExposure(RgbImage{}), 0);
  EXPECT_EQ(autoExposure(grey({1e-38f})), 50) << "within what an exposure may be";
}

}  // namespace
}  // namespace ninefold
