#include "common/image/tone_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ninefold {
namespace {

// The curve of the header, in double and without the table.
double exactCode(double radiance) {
  const double a = 0.8;
  const double y =
      radiance <= a ? radiance : a + (1 - a) * (1 - std::exp(-(radiance - a) / (1 - a)));
  return 255 * (y <= 0.0031308 ? 12.92 * y : 1.055 * std::pow(y, 1 / 2.4) - 0.055);
}

TEST(ToneMap, FollowsItsCurveWithinOneCodeAndNeverFalls) {
  const ToneMap toneMap;
  int last = 0;
  for (double x = 1e-7; x < 1e4; x *= 1.0007) {
    const int code = toneMap.code(static_cast<float>(x));
    ASSERT_NEAR(code, exactCode(x), 0.65) << x;
    ASSERT_GE(code, last);
    last = code;
  }
  EXPECT_EQ(last, 255);
}

TEST(ToneMap, ExposureIsAFactorOfTwoPerStop) {
  const ToneMap plain, brighter(1.5f), darker(-3);
  for (float x = 1e-5f; x < 100; x *= 1.1f) {
    EXPECT_EQ(darker.code(8 * x), plain.code(x));
    EXPECT_NEAR(brighter.code(x / std::exp2(1.5f)), plain.code(x), 1);
  }
}

TEST(ToneMap, ShowsWhatIsNoColour) {
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              inf = std::numeric_limits<float>::infinity();
  RgbImage image;
  image.reset(4, 1);
  image.pixels = {{0, -1, inf, 0.5f}, {0, -inf, inf, nan}, {0, -0.0f, inf, 0.5f}};
  std::vector<uint8_t> rgb;
  ToneMap().apply(image, rgb);
  EXPECT_EQ(rgb, (std::vector<uint8_t>{0, 0, 0, 0, 0, 0, 255, 255, 255, 255, 0, 255}));
}

TEST(SrgbCurve, IsInvertedByItsInverse) {
  for (float code = 0; code <= 1; code += 0.001f)
    EXPECT_NEAR(srgbFromLinear(linearFromSrgb(code)), code, 1e-6f);
  EXPECT_NEAR(linearFromSrgb(0.5f), 0.21404f, 1e-5f);
}

}  // namespace
}  // namespace ninefold
