#include "common/image/tone_map.h"

#include <gtest/gtest.h>

#include <algorithm>
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

double oetf(double y) {
  return 255 * (y <= 0.0031308 ? 12.92 * y : 1.055 * std::pow(y, 1 / 2.4) - 0.055);
}

// Hable's curve by fixed points: h(x) = (x(0.15x+0.05)+0.004)/(x(0.15x+0.5)+0.06) - 1/15.
TEST(ToneMap, FilmicMeetsItsFixedPoints) {
  const auto h = [](double x) {
    return (x * (0.15 * x + 0.05) + 0.004) / (x * (0.15 * x + 0.5) + 0.06) - 1.0 / 15;
  };
  EXPECT_NEAR(h(11.2), 0.72514, 1e-4);
  const ToneMap filmic(Tone{0, ToneCurve::filmic});
  for (const double x : {0.0, 0.01, 0.18, 0.5, 1.0, 3.0})
    EXPECT_NEAR(filmic.code(static_cast<float>(x)), oetf(h(2 * x) / h(11.2)), 0.65) << x;
  EXPECT_EQ(filmic.code(5.6f), 255) << "white";
  EXPECT_EQ(filmic.code(100), 255);
  EXPECT_EQ(filmic.code(0.18f), 100) << "h(0.36) = 0.0931, over white 0.1283, OETF 0.3935";
}

TEST(ToneMap, FilmicHasNoCellOnTheEdgeBetweenTwoCodes) {
  const auto h = [](double x) {
    return (x * (0.15 * x + 0.05) + 0.004) / (x * (0.15 * x + 0.5) + 0.06) - 0.02 / 0.3;
  };
  for (int exponent = -14; exponent < 3; ++exponent)
    for (int cell = 0; cell < 1024; ++cell) {
      const double x = std::ldexp(1 + (cell + 0.5) / 1024, exponent);
      const double code = std::min(oetf(h(2 * x) / h(11.2)), 255.0);
      ASSERT_GT(std::abs(code - std::floor(code) - 0.5), 1e-5) << x;
    }
}

// Greys keep their hue to a code or two; t = (log2 x + 12.47393)/16.5 of middle grey is 0.6061, its
// c = 0.4967: a code of 127.
TEST(ToneMap, AgxMeetsItsFixedPoints) {
  const auto c = [](double x) {
    const double t = std::clamp((std::log2(x) + 12.47393) / 16.5, 0.0, 1.0);
    return ((((((15.5 * t - 40.14) * t + 31.96) * t - 6.868) * t + 0.4298) * t + 0.1191) * t) -
           0.00232;
  };
  const ToneMap agx(Tone{0, ToneCurve::agx});
  for (const double x : {1e-3, 0.01, 0.18, 0.5, 1.0, 4.0, 16.0}) {
    const ToneMap::Codes codes = agx.codes(Vec3(static_cast<float>(x)));
    for (const uint8_t code : codes) EXPECT_NEAR(code, 255 * c(x), 1.1) << x;
  }
  EXPECT_EQ(agx.code(0), 0);
  EXPECT_NEAR(agx.code(1e6f), 255 * c(17), 1.1);
}

// What would clip to pure red turns light instead: the other channels rise with it.
TEST(ToneMap, AgxTurnsStrongColoursWhite) {
  const ToneMap agx(Tone{0, ToneCurve::agx}), plain;
  int before = 0;
  for (float x = 1; x < 1000; x *= 4) {
    const ToneMap::Codes codes = agx.codes(Vec3(x, 0, 0));
    EXPECT_GE(codes[0], codes[1]);
    EXPECT_GE(codes[1], before);
    before = codes[1];
  }
  EXPECT_GT(before, 60);
  EXPECT_EQ(plain.codes(Vec3(1000, 0, 0))[1], 0);
}

TEST(ToneMap, EveryCurveRisesMapsPartsAsTheWholeAndMarksNan) {
  for (const ToneCurve curve : {ToneCurve::srgb, ToneCurve::filmic, ToneCurve::agx}) {
    const ToneMap map(Tone{0.5f, curve});
    int last = 0;
    for (float x = 1e-6f; x < 1e4f; x *= 1.01f) {
      ASSERT_GE(map.code(x), last);
      last = map.code(x);
    }
    RgbImage image;
    image.reset(3, 1);
    image.pixels = {{0.2f, 4, 0.5f}, {0.7f, 0.1f, NAN}, {0.05f, 2, 0.5f}};
    DisplayImage codes;
    map.apply(image, codes);
    for (size_t i = 0; i < 2; ++i) {
      const ToneMap::Codes one = map.codes(image.rgb(i));
      for (size_t c = 0; c < 3; ++c) EXPECT_EQ(codes.rgb[3 * i + c], one[c]);
    }
    EXPECT_EQ(std::vector(codes.rgb.begin() + 6, codes.rgb.end()),
              (std::vector<uint8_t>{255, 0, 255}));
  }
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
