#include "common/image/tone_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

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

// Clients and master each make their own table: logarithms and powers of all libraries must lead to
// it. The curve rises, so that no cell's middle is a code's edge but by chance.
TEST(ToneMap, HasNoCellOnTheEdgeBetweenTwoCodes) {
  for (int exponent = -14; exponent < 3; ++exponent)
    for (int cell = 0; cell < 1024; ++cell) {
      const double code = exactCode(std::ldexp(1 + (cell + 0.5) / 1024, exponent));
      ASSERT_GT(std::abs(code - std::floor(code) - 0.5), 1e-5) << exponent << " " << cell;
    }
}

// As an image and pixel by pixel, wherever the run of pixels begins and ends.
TEST(ToneMap, MapsPartsAsTheWhole) {
  RgbImage image;
  image.reset(37, 5);
  std::mt19937 random(4);
  std::lognormal_distribution<float> any(0, 4);
  for (auto* plane : {&image.pixels.r, &image.pixels.g, &image.pixels.b})
    for (float& value : *plane) value = any(random);
  const ToneMap toneMap(-1.25f);
  DisplayImage codes;
  toneMap.apply(image, codes);
  ASSERT_EQ(codes.rgb.size(), 3 * image.count());
  for (size_t i = 0; i < image.count(); ++i)
    for (size_t c = 0; c < 3; ++c)
      ASSERT_EQ(codes.rgb[3 * i + c], toneMap.code(image.rgb(i)[static_cast<int>(c)]));
  std::vector<uint8_t> part(3 * 83);
  toneMap.apply(image.pixels, 101, 83, part.data());
  EXPECT_TRUE(std::equal(part.begin(), part.end(), codes.rgb.begin() + 3 * 101));
}

TEST(ToneMap, ShowsWhatIsNoColour) {
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              inf = std::numeric_limits<float>::infinity();
  RgbImage image;
  image.reset(4, 1);
  image.pixels = {{0, -1, inf, 0.5f}, {0, -inf, inf, nan}, {0, -0.0f, inf, 0.5f}};
  DisplayImage codes;
  ToneMap().apply(image, codes);
  EXPECT_EQ(codes.rgb, (std::vector<uint8_t>{0, 0, 0, 0, 0, 0, 255, 255, 255, 255, 0, 255}));
}

TEST(SrgbCurve, IsInvertedByItsInverse) {
  for (float code = 0; code <= 1; code += 0.001f)
    EXPECT_NEAR(srgbFromLinear(linearFromSrgb(code)), code, 1e-6f);
  EXPECT_NEAR(linearFromSrgb(0.5f), 0.21404f, 1e-5f);
}

}  // namespace
}  // namespace ninefold
