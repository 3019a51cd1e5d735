#include "common/image/film.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ninefold {
namespace {

RgbImage constantImage(int width, int height, float value) {
  RgbImage image;
  image.reset(width, height);
  for (auto* plane : {&image.pixels.r, &image.pixels.g, &image.pixels.b})
    std::fill(plane->begin(), plane->end(), value);
  return image;
}

TEST(Film, DoesNotDriftOverAMillionFrames) {
  Film film(3, 2);
  RgbImage frame = constantImage(3, 2, 0.1f);
  std::mt19937 random(11);
  std::uniform_real_distribution<float> uniform(0, 2);
  const int frames = 1000000;
  long double sum = 0, squares = 0;
  for (int n = 0; n < frames; ++n) {
    const float x = 1000 + uniform(random);
    frame.pixels.g[4] = x;
    sum += x, squares += static_cast<long double>(x) * x;
    film.add(frame);
  }
  const long double mean = sum / frames;
  const long double variance = (squares - mean * sum) / (frames - 1);
  RgbImage image, error;
  film.mean(image), film.standardError(error);
  EXPECT_EQ(film.frames(), frames);
  EXPECT_EQ(image.pixels.r[4], 0.1f);  // alike frames: exact
  EXPECT_EQ(error.pixels.r[4], 0);
  EXPECT_EQ(image.pixels.g[4], static_cast<float>(mean));
  EXPECT_NEAR(error.pixels.g[4] / std::sqrt(static_cast<double>(variance) / frames), 1, 1e-6);
}

TEST(Film, GivesTheClosedFormErrorOfTwoFrames) {
  Film film(40, 20);
  EXPECT_TRUE(std::isinf(film.relativeError()));
  film.add(constantImage(40, 20, 1));
  EXPECT_TRUE(std::isinf(film.relativeError()));
  film.add(constantImage(40, 20, 3));
  // s^2 = 2 with one degree of freedom, so s/sqrt(N) = 1; mean 2.
  RgbImage error;
  film.standardError(error);
  EXPECT_FLOAT_EQ(error.pixels.b[799], 1);
  EXPECT_NEAR(film.relativeError(), 0.5, 1e-6);
  EXPECT_NEAR(film.imageRelativeError(), 0.5, 1e-6);
}

// One light set too bright in a frame makes all its pixels bright: N values, not N times the
// pixels.
TEST(Film, DoesNotAverageAwayErrorsThatPixelsShare) {
  const int frames = 400;
  std::mt19937 random(2);
  std::normal_distribution<float> normal(1, 0.2f);
  Film shared(64, 64), independent(64, 64);
  for (int n = 0; n < frames; ++n) {
    shared.add(constantImage(64, 64, normal(random)));
    RgbImage frame = constantImage(64, 64, 0);
    for (size_t i = 0; i < frame.count(); ++i)
      frame.pixels.r[i] = frame.pixels.g[i] = frame.pixels.b[i] = normal(random);
    independent.add(frame);
  }
  const double pixel = 0.2 / std::sqrt(frames);
  EXPECT_NEAR(shared.relativeError() / pixel, 1, 0.1);
  EXPECT_NEAR(shared.imageRelativeError() / pixel, 1, 0.1);
  EXPECT_NEAR(independent.relativeError() / (pixel / 16), 1, 0.1);       // 256 pixels a block
  EXPECT_NEAR(independent.imageRelativeError() / (pixel / 64), 1, 0.1);  // 4096 in all
}

// The standard error is what it says: over many films, means spread by as much as each film claims.
TEST(Film, StatesTheErrorThatItHas) {
  std::mt19937 random(4);
  std::exponential_distribution<float> exponential(1);
  const int films = 2000, frames = 64;
  double claimed = 0, squared = 0;
  RgbImage mean, error;
  for (int f = 0; f < films; ++f) {
    Film film(1, 1);
    for (int n = 0; n < frames; ++n) film.add(constantImage(1, 1, exponential(random)));
    film.mean(mean), film.standardError(error);
    squared += std::pow(static_cast<double>(mean.pixels.r[0]) - 1, 2);
    claimed += std::pow(static_cast<double>(error.pixels.r[0]), 2);
  }
  EXPECT_NEAR(claimed / squared, 1, 0.1);
}

TEST(Film, HasPartBlocksAtTheEdgesThatCountByTheirPixels) {
  Film film(17, 1);  // a block of 16 pixels and one of 1, which alone is noisy
  for (const float x : {0.0f, 2.0f}) {
    RgbImage frame = constantImage(17, 1, 1);
    frame.pixels.r[16] = frame.pixels.g[16] = frame.pixels.b[16] = x;
    film.add(frame);
  }
  EXPECT_NEAR(film.relativeError(), std::sqrt(1.0 / 17), 1e-6);
  EXPECT_NEAR(film.imageRelativeError(), 1.0 / 17, 1e-6);
}

TEST(Film, StartsAgainAfterClear) {
  Film film(4, 4);
  film.add(constantImage(4, 4, 1));
  film.add(constantImage(4, 4, 2));
  film.clear();
  EXPECT_EQ(film.frames(), 0);
  film.add(constantImage(4, 4, 5));
  RgbImage image;
  film.mean(image);
  EXPECT_EQ(image.rgb(3), Vec3(5));
}

TEST(Film, OfBlackFramesHasNoError) {
  Film film(20, 20);
  for (int n = 0; n < 3; ++n) film.add(constantImage(20, 20, 0));
  EXPECT_EQ(film.relativeError(), 0);
}

TEST(ImageHash, TellsPicturesApart) {
  const RgbImage image = constantImage(5, 4, 1);
  EXPECT_EQ(imageHash(image), imageHash(constantImage(5, 4, 1)));
  EXPECT_EQ(imageHash(image).size(), 16u);
  EXPECT_NE(imageHash(image), imageHash(constantImage(4, 5, 1)));
  RgbImage nextFloat = image, otherPlane = image, moved = image;
  nextFloat.pixels.b[19] = std::nextafter(1.0f, 2.0f);
  otherPlane.pixels.g[19] = std::nextafter(1.0f, 2.0f);
  moved.pixels.b[18] = std::nextafter(1.0f, 2.0f);
  EXPECT_NE(imageHash(image), imageHash(nextFloat));
  EXPECT_NE(imageHash(nextFloat), imageHash(otherPlane));
  EXPECT_NE(imageHash(nextFloat), imageHash(moved));
}

// FNV-1a of the eight bytes of the size 0 x 0, computed by hand from its definition.
TEST(ImageHash, IsFnv1a) {
  uint64_t hash = 14695981039346656037u;
  for (int byte = 0; byte < 8; ++byte) hash *= 1099511628211u;
  EXPECT_EQ(std::stoull(imageHash(RgbImage{}), nullptr, 16), hash);
}

}  // namespace
}  // namespace ninefold
