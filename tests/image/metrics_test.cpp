#include "common/image/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "common/base/error.h"
#include "common/image/tone_map.h"

namespace ninefold {
namespace {

RgbImage grey(int width, int height, float value) {
  RgbImage image;
  image.reset(width, height);
  for (auto* plane : {&image.pixels.r, &image.pixels.g, &image.pixels.b})
    std::fill(plane->begin(), plane->end(), value);
  return image;
}

RgbImage noise(int width, int height, uint32_t seed) {
  RgbImage image = grey(width, height, 0);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(0, 2);
  for (size_t i = 0; i < image.count(); ++i)
    image.pixels.r[i] = uniform(random), image.pixels.g[i] = uniform(random),
    image.pixels.b[i] = uniform(random);
  return image;
}

TEST(Metrics, OfAnImageAndItselfAreZero) {
  const RgbImage image = noise(33, 21, 1);
  const Metrics m = compareImages(image, image);
  EXPECT_EQ(m.rmse, 0);
  EXPECT_EQ(m.rmsePercent, 0);
  EXPECT_EQ(m.relMse, 0);
  EXPECT_EQ(m.relMseTrimmed, 0);
  for (const double bias : m.bias) EXPECT_EQ(bias, 0);
  EXPECT_NEAR(m.ssim, 1, 1e-12);
}

TEST(Metrics, OfAnEvenErrorHaveClosedForms) {
  for (const float scale : {1e-4f, 1.0f, 1e4f}) {  // all but rmse do not know the unit
    const Metrics m = compareImages(grey(20, 10, 4.4f * scale), grey(20, 10, 4 * scale));
    EXPECT_NEAR(m.rmse / scale, 0.4, 1e-6);
    EXPECT_NEAR(m.rmsePercent, 10, 1e-5);
    EXPECT_NEAR(m.relMse, 0.01 / 1.01, 1e-7);
    EXPECT_NEAR(m.relMseTrimmed, 0.01 / 1.01, 1e-7);
    for (const double bias : m.bias) EXPECT_NEAR(bias, 0.1, 1e-6);
    // Without contrast only the first factor is left: of the codes of 0.198 and 0.18.
    const double x = static_cast<double>(srgbFromLinear(0.198f)),
                 r = static_cast<double>(srgbFromLinear(0.18f));
    EXPECT_NEAR(m.ssim, (2 * x * r + 1e-4) / (x * x + r * r + 1e-4), 1e-6);
  }
}

TEST(Metrics, KeepChannelsApartInTheBias) {
  RgbImage image = grey(8, 8, 2);
  std::fill(image.pixels.r.begin(), image.pixels.r.end(), 3.0f);
  std::fill(image.pixels.b.begin(), image.pixels.b.end(), 1.0f);
  const Metrics m = compareImages(image, grey(8, 8, 2));
  EXPECT_DOUBLE_EQ(m.bias[0], 0.5);
  EXPECT_DOUBLE_EQ(m.bias[1], 0);
  EXPECT_DOUBLE_EQ(m.bias[2], -0.5);
  EXPECT_NEAR(m.rmse, std::sqrt(2.0 / 3), 1e-7);
}

TEST(Metrics, TrimTheTopThousandthAndNameTheWorstPixel) {
  RgbImage image = grey(100, 20, 1);  // two of 2000 pixels are trimmed
  image.pixels.r[image.at(70, 5)] = 101;
  image.pixels.g[image.at(3, 19)] = 51;
  const Metrics m = compareImages(image, grey(100, 20, 1));
  EXPECT_NEAR(m.relMse, (10000 + 2500) / 1.01 / 6000, 1e-6);
  EXPECT_EQ(m.relMseTrimmed, 0);
  EXPECT_EQ(m.worst.x, 70);
  EXPECT_EQ(m.worst.y, 5);
  EXPECT_EQ(m.worst.image, Vec3(101, 1, 1));
  EXPECT_EQ(m.worst.reference, Vec3(1));
  EXPECT_NEAR(m.worst.relMse, 10000 / 1.01 / 3, 1e-4);
  image.pixels.b[0] = 2;  // a third wrong pixel stays
  EXPECT_NEAR(compareImages(image, grey(100, 20, 1)).relMseTrimmed, 1 / 1.01 / 3 / 1998, 1e-9);
}

TEST(Metrics, CountAndLeaveOutWhatIsNotFinite) {
  RgbImage image = grey(10, 10, 1.5f), reference = grey(10, 10, 1);
  image.pixels.g[7] = std::numeric_limits<float>::quiet_NaN();
  image.pixels.r[8] = std::numeric_limits<float>::infinity();
  reference.pixels.b[9] = -std::numeric_limits<float>::infinity();
  const Metrics m = compareImages(image, reference);
  EXPECT_EQ(m.nonFiniteImage, 2);
  EXPECT_EQ(m.nonFiniteReference, 1);
  EXPECT_DOUBLE_EQ(m.rmse, 0.5);
  EXPECT_DOUBLE_EQ(m.bias[1], 0.5);
  EXPECT_TRUE(std::isfinite(m.ssim));
}

TEST(Metrics, HaveNoRelativeFiguresAgainstBlack) {
  const Metrics m = compareImages(grey(4, 4, 1), grey(4, 4, 0));
  EXPECT_EQ(m.rmse, 1);
  for (const double figure : {m.rmsePercent, m.relMse, m.relMseTrimmed, m.ssim, m.bias[2]})
    EXPECT_TRUE(std::isnan(figure));
}

TEST(Metrics, RefuseImagesOfTwoSizes) {
  EXPECT_THROW(compareImages(grey(4, 4, 1), grey(4, 5, 1)), Error);
}

TEST(Ssim, FallsWithNoiseAndHardlyWithBrightness) {
  RgbImage reference = noise(64, 64, 1), brighter = reference;
  for (auto* plane : {&brighter.pixels.r, &brighter.pixels.g, &brighter.pixels.b})
    for (float& v : *plane) v *= 1.1f;
  const double even = compareImages(brighter, reference).ssim;
  const double unrelated = compareImages(noise(64, 64, 2), reference).ssim;
  EXPECT_GT(even, 0.98);
  EXPECT_LT(even, 1);
  EXPECT_LT(unrelated, 0.2);
}

}  // namespace
}  // namespace ninefold
