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

void setPixel(RgbImage& image, size_t i, float value) {
  image.pixels.r[i] = image.pixels.g[i] = image.pixels.b[i] = value;
}

// The error of eight replications' mean, from their own definition.
double errorOf(const std::vector<long double>& means) {
  long double mean = 0, squares = 0;
  for (const long double m : means) mean += m / 8;
  for (const long double m : means) squares += (m - mean) * (m - mean);
  return static_cast<double>(std::sqrt(squares / 7 / 8));
}

TEST(Film, DoesNotDriftOverAMillionFrames) {
  Film film(3, 2);
  RgbImage frame = constantImage(3, 2, 0.1f);
  std::mt19937 random(11);
  std::uniform_real_distribution<float> uniform(0, 2);
  const int frames = 1000000;
  long double sum = 0;
  std::vector<long double> replications(8);
  for (int n = 0; n < frames; ++n) {
    const float x = 10 + uniform(random);
    setPixel(frame, 4, x);
    sum += x, replications[static_cast<size_t>(n % 8)] += x / (frames / 8.0L);
    film.add(frame);
  }
  RgbImage image;
  film.mean(image);
  EXPECT_EQ(film.frames(), frames);
  EXPECT_EQ(image.pixels.r[1], 0.1f);  // alike frames: exact
  EXPECT_EQ(film.standardError()[1], 0);
  EXPECT_EQ(image.pixels.g[4], static_cast<float>(sum / frames));
  EXPECT_NEAR(film.standardError()[4] / errorOf(replications), 1, 0.05);
}

// What a filter adds is noise around little: skewed noise, as rounding might add up there. Its mean
// after N frames is known to 1/sqrt N, a thousandth.
TEST(Film, DifferencesInFloatDoNotDriftOverAMillionFrames) {
  FilmLayer<float> layer(1, 1, false);
  std::mt19937 random(12);
  std::exponential_distribution<float> noise;
  const int frames = 1000000;
  long double sum = 0;
  for (int n = 0; n < frames; ++n) {
    const float x = noise(random) - 0.9f;
    sum += x;
    layer.add(0, {&x, &x, &x, {&x, 1}}, n);
  }
  RgbImage image;
  image.reset(1, 1);
  layer.write({0, 0, 1, 1}, image);
  EXPECT_NEAR(image.pixels.g[0], static_cast<float>(sum / frames), 1e-5);
}

// Frames 8 apart make up for each other: what they differ by is no error, the replications' spread
// is.
TEST(Film, TakesTheErrorFromReplications) {
  Film film(1, 1);
  const std::vector<float> values = {3, 1, 4, 1, 5, 9, 2, 6};
  for (const float sign : {1.0f, -1.0f})
    for (const float v : values) film.add(constantImage(1, 1, v + 2 * sign));
  const double error = errorOf({values.begin(), values.end()});
  EXPECT_NEAR(film.standardError()[0], error, 1e-6);
  EXPECT_NEAR(film.imageRelativeError(), error / (31.0 / 8), 1e-6);
}

// A tile's mean and error are there as soon as the tile is, and are those of the whole frame later.
TEST(Film, KnowsATileBeforeItsFrameIsDone) {
  Film film(40, 20);
  RgbImage partly, whole;
  partly.reset(40, 20);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(0, 2);
  for (int n = 0; n < 3; ++n) {
    RgbImage tile = constantImage(8, 4, 0);
    for (size_t i = 0; i < tile.count(); ++i) setPixel(tile, i, uniform(random));
    film.addTile(0, 0, constantImage(40, 16, 1));
    film.addTile(32, 16, tile);
    film.meanOfTile({32, 16, 8, 4}, partly);
    const float error = film.standardError(17 * 40 + 35, n + 1);
    film.addTile(0, 16, constantImage(32, 4, 1));
    film.frameDone();
    film.mean(whole);
    for (int y = 16; y < 20; ++y)
      for (int x = 32; x < 40; ++x)
        ASSERT_EQ(partly.rgb(partly.at(x, y)), whole.rgb(whole.at(x, y)));
    EXPECT_EQ(partly.rgb(0), Vec3(0)) << "another tile's place";
    EXPECT_EQ(error, film.standardError()[17 * 40 + 35]);
    EXPECT_EQ(error > 0, n > 0);
  }
}

TEST(Film, GivesTheClosedFormErrorOfTwoFrames) {
  Film film(40, 20);
  EXPECT_TRUE(std::isinf(film.relativeError()));
  film.add(constantImage(40, 20, 1));
  EXPECT_TRUE(std::isinf(film.relativeError()));
  film.add(constantImage(40, 20, 3));
  // s^2 = 2 with one degree of freedom, so s/sqrt(N) = 1; mean 2.
  EXPECT_FLOAT_EQ(film.standardError()[799], 1);
  EXPECT_NEAR(film.relativeError(), 0.5, 1e-6);
  EXPECT_NEAR(film.imageRelativeError(), 0.5, 1e-6);
}

// One light set too bright in a frame makes all its pixels bright: N values, not N times the
// pixels.
TEST(Film, DoesNotAverageAwayErrorsThatPixelsShare) {
  const int films = 200, frames = 16;
  std::mt19937 random(2);
  std::normal_distribution<float> normal(1, 0.2f);
  double shared[2] = {}, independent[2] = {};  // mean squares of the errors of blocks and image
  for (int f = 0; f < films; ++f) {
    Film together(32, 32), apart(32, 32);
    for (int n = 0; n < frames; ++n) {
      together.add(constantImage(32, 32, normal(random)));
      RgbImage frame = constantImage(32, 32, 0);
      for (size_t i = 0; i < frame.count(); ++i) setPixel(frame, i, normal(random));
      apart.add(frame);
    }
    shared[0] += std::pow(together.relativeError(), 2) / films;
    shared[1] += std::pow(together.imageRelativeError(), 2) / films;
    independent[0] += std::pow(apart.relativeError(), 2) / films;
    independent[1] += std::pow(apart.imageRelativeError(), 2) / films;
  }
  const double pixel = 0.2 * 0.2 / frames;
  EXPECT_NEAR(shared[0] / pixel, 1, 0.2);
  EXPECT_NEAR(shared[1] / pixel, 1, 0.2);
  EXPECT_NEAR(independent[0] / (pixel / 256), 1, 0.2);   // 256 pixels a block
  EXPECT_NEAR(independent[1] / (pixel / 1024), 1, 0.2);  // 1024 in all
}

// The standard error is what it says: over many films, means spread by as much as each film claims.
TEST(Film, StatesTheErrorThatItHas) {
  std::mt19937 random(4);
  std::exponential_distribution<float> exponential(1);
  const int films = 2000, frames = 64;
  double claimed = 0, squared = 0;
  RgbImage mean;
  for (int f = 0; f < films; ++f) {
    Film film(1, 1);
    for (int n = 0; n < frames; ++n) film.add(constantImage(1, 1, exponential(random)));
    film.mean(mean);
    squared += std::pow(static_cast<double>(mean.pixels.r[0]) - 1, 2);
    claimed += std::pow(static_cast<double>(film.standardError()[0]), 2);
  }
  EXPECT_NEAR(claimed / squared, 1, 0.1);
}

TEST(Film, HasPartBlocksAtTheEdgesThatCountByTheirPixels) {
  Film film(17, 1);  // a block of 16 pixels and one of 1, which alone is noisy
  for (const float x : {0.0f, 2.0f}) {
    RgbImage frame = constantImage(17, 1, 1);
    setPixel(frame, 16, x);
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
