// The last touch of a shown picture: it takes noise away where the film states an error, and
// nothing else.
#include "common/image/denoise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "common/image/film.h"

namespace ninefold {
namespace {

constexpr int kWidth = 90, kHeight = 70;  // more than one strip and one band, none of them whole
constexpr size_t kPixels = size_t{kWidth} * kHeight;

// A wall straight ahead, white.
DenoiseGuides wall() {
  DenoiseGuides guides;
  guides.albedo.assign(kPixels, 0.8f);
  guides.normal.resize(kPixels);
  guides.normal.b.assign(kPixels, 1.0f);
  guides.nearness.assign(kPixels, 0.25f);
  return guides;
}

template <typename F>
RgbImage imageOf(const F& colorAt) {
  RgbImage image;
  image.reset(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const Vec3 c = colorAt(x, y);
      const size_t i = image.at(x, y);
      image.pixels.r[i] = c.x, image.pixels.g[i] = c.y, image.pixels.b[i] = c.z;
    }
  return image;
}

RgbImage noisy(const RgbImage& truth, float deviation, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal(0, deviation);
  return imageOf([&](int x, int y) { return truth.rgb(truth.at(x, y)) + Vec3(normal(random)); });
}

RgbImage touched(RgbImage picture, const std::vector<float>& error, const DenoiseGuides& guides,
                 int threads = 2) {
  denoise(picture, error, guides, threads);
  return picture;
}

double squaredError(const RgbImage& image, const RgbImage& truth) {
  double sum = 0;
  for (size_t i = 0; i < kPixels; ++i) {
    const Vec3 off = image.rgb(i) - truth.rgb(i);
    sum += static_cast<double>(glm::dot(off, off));
  }
  return sum / kPixels;
}

const std::vector<float> kErrors(kPixels, 0.1f);

RgbImage slope() {
  return imageOf([](int x, int y) { return Vec3(0.5f + 0.01f * static_cast<float>(x + 2 * y)); });
}

TEST(Denoise, ConstantStaysBitForBit) {
  const RgbImage flat = imageOf([](int, int) { return Vec3(0.1f, 0.3f, 0.7f); });
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform;
  DenoiseGuides guides = wall();
  std::vector<float> errors(kPixels);
  for (size_t i = 0; i < kPixels; ++i)
    errors[i] = uniform(random), guides.albedo[i] = uniform(random),
    guides.normal.r[i] = uniform(random), guides.nearness[i] = uniform(random);
  EXPECT_EQ(touched(flat, errors, guides), flat);
}

TEST(Denoise, PixelsWithoutErrorStayBitForBit) {
  const RgbImage picture = noisy(slope(), 0.1f, 1);
  EXPECT_EQ(touched(picture, std::vector<float>(kPixels, 0), wall()), picture);
  std::vector<float> errors = kErrors;
  for (size_t i = 0; i < kPixels; i += 2) errors[i] = 0;
  const RgbImage half = touched(picture, errors, wall());
  size_t moved = 0;
  for (size_t i = 0; i < kPixels; ++i) {
    if (i % 2 == 0) {
      ASSERT_EQ(half.rgb(i), picture.rgb(i)) << i;
    }
    moved += half.rgb(i) != picture.rgb(i);
  }
  EXPECT_GT(moved, kPixels / 4);
}

TEST(Denoise, NoPixelMovesBeyondItsError) {
  const RgbImage picture = noisy(slope(), 0.3f, 2);
  const RgbImage out = touched(picture, kErrors, wall());
  for (size_t i = 0; i < kPixels; ++i)
    ASSERT_LE(std::abs(luminance(out.rgb(i)) - luminance(picture.rgb(i))), 0.1f * 1.0001f) << i;
}

TEST(Denoise, NoiseOfALitWallFallsToAFifthAndItsSlopeStays) {
  const RgbImage truth = slope();
  const RgbImage picture = noisy(truth, 0.1f, 3);
  const RgbImage out = touched(picture, kErrors, wall());
  EXPECT_LT(squaredError(out, truth), 0.2 * squaredError(picture, truth));
}

TEST(Denoise, LoneFireflyGoesAndDoesNotSpread) {
  const RgbImage truth = slope();
  RgbImage picture = truth;
  std::vector<float> errors(kPixels, 0.001f);
  const size_t firefly = picture.at(40, 30);
  for (auto* plane : {&picture.pixels.r, &picture.pixels.g, &picture.pixels.b})
    (*plane)[firefly] += 50;
  errors[firefly] = 50;  // as one replication of many with all the light states it
  // Neighbours that believe in an error of their own could take from it.
  for (int y = 25; y < 36; ++y)
    for (int x = 35; x < 46; ++x)
      if (picture.at(x, y) != firefly) errors[picture.at(x, y)] = 0.05f;
  const RgbImage out = touched(picture, errors, wall());
  for (size_t i = 0; i < kPixels; ++i)
    ASSERT_NEAR(luminance(out.rgb(i)), luminance(truth.rgb(i)), i == firefly ? 0.1f : 0.005f) << i;
}

TEST(Denoise, TextureOfAlbedoStays) {
  // Tiles of 6 pixels, and a texture in which no two pixels are alike.
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(0.1f, 0.9f);
  for (const bool isFine : {false, true}) {
    DenoiseGuides guides = wall();
    const RgbImage truth = imageOf([&](int x, int y) {
      float& albedo = guides.albedo[static_cast<size_t>(y * kWidth + x)];
      albedo = isFine ? uniform(random) : (x / 6 + y / 6) % 2 == 0 ? 0.45f : 0.55f;
      return Vec3(albedo) * Vec3(1, 0.8f, 0.6f);
    });
    const RgbImage picture = noisy(truth, 0.05f, 8);
    const RgbImage out = touched(picture, std::vector<float>(kPixels, 0.05f), guides);
    EXPECT_LT(squaredError(out, truth), (isFine ? 1.0 : 0.4) * squaredError(picture, truth));
  }
}

TEST(Denoise, EdgeOfGeometryStays) {
  DenoiseGuides guides = wall();
  const RgbImage truth = imageOf([&](int x, int y) {
    const auto i = static_cast<size_t>(y * kWidth + x);
    if (x < 45) guides.normal.r[i] = 1, guides.normal.b[i] = 0, guides.nearness[i] = 0.5f;
    return Vec3(x < 45 ? 0.5f : 0.6f);  // no more apart than twice the error
  });
  const RgbImage picture = noisy(truth, 0.05f, 9);
  const RgbImage out = touched(picture, std::vector<float>(kPixels, 0.05f), guides);
  double left = 0, right = 0;
  for (int y = 0; y < kHeight; ++y)
    left += static_cast<double>(out.rgb(out.at(44, y)).x) / kHeight,
        right += static_cast<double>(out.rgb(out.at(45, y)).x) / kHeight;
  EXPECT_NEAR(right - left, 0.1, 0.015);
}

TEST(Denoise, ManyThreadsGiveTheSameBytes) {
  const RgbImage picture = noisy(slope(), 0.1f, 4);
  const RgbImage one = touched(picture, kErrors, wall(), 1);
  for (const int threads : {2, 3, 7}) EXPECT_EQ(touched(picture, kErrors, wall(), threads), one);
}

TEST(Denoise, StopsWhenItIsTold) {
  RgbImage picture = noisy(slope(), 0.1f, 4);
  const RgbImage before = picture;
  std::stop_source source;
  source.request_stop();
  EXPECT_FALSE(denoise(picture, kErrors, wall(), 2, source.get_token()));
  EXPECT_EQ(picture, before);
  EXPECT_TRUE(denoise(picture, kErrors, wall(), 2));
}

TEST(Denoise, NobodyTakesFromPixelsThatAreNotFinite) {
  RgbImage picture = noisy(slope(), 0.1f, 6);
  picture.pixels.g[picture.at(20, 20)] = std::numeric_limits<float>::quiet_NaN();
  picture.pixels.r[picture.at(50, 20)] = std::numeric_limits<float>::infinity();
  const RgbImage out = touched(picture, kErrors, wall());
  size_t bad = 0;
  for (size_t i = 0; i < kPixels; ++i) bad += !isFinite(out.rgb(i));
  EXPECT_EQ(bad, 2u);
}

// The film's own error is enough, and what the touch does fades with it: as frames^(-1/2) at most.
TEST(Denoise, FadesAsTheFilmsErrorFalls) {
  const RgbImage truth = slope();
  Film film(kWidth, kHeight);
  double before = 0;
  for (unsigned f = 0; f < 256; ++f) {
    film.add(noisy(truth, 0.4f, 100 + f));
    if (f != 15 && f != 255) continue;
    RgbImage mean;
    film.mean(mean);
    const RgbImage out = touched(mean, film.standardError(), wall());
    EXPECT_LT(squaredError(out, truth), 0.35 * squaredError(mean, truth)) << f;
    const double change = std::sqrt(squaredError(out, mean));
    if (f == 255) {
      EXPECT_LT(change, 0.3 * before);
    }
    before = change;
  }
}

}  // namespace
}  // namespace ninefold
