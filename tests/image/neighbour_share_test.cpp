// Frames whose noise is known: normal, of deviation 1, independent in each pixel, around E. F is
// the mean of 3 x 3 pixels, of those that the image has at its border.
#include "common/image/neighbour_share.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "common/image/film.h"

namespace ninefold {
namespace {

constexpr int kSide = 48;

float edge(int x) { return x < kSide / 2 ? 10.0f : 11.0f; }
float flat(int) { return 10; }

void set(RgbImage& image, int x, int y, float v) {
  const size_t i = image.at(x, y);
  image.pixels.r[i] = image.pixels.g[i] = image.pixels.b[i] = v;
}

float filtered(const RgbImage& image, int x, int y) {
  float sum = 0, pixels = 0;
  for (int j = std::max(0, y - 1); j <= std::min(kSide - 1, y + 1); ++j)
    for (int i = std::max(0, x - 1); i <= std::min(kSide - 1, x + 1); ++i)
      sum += image.rgb(image.at(i, j)).x, ++pixels;
  return sum / pixels;
}

class Frames {
 public:
  explicit Frames(unsigned seed, float noise = 1) : random_(seed), normal_(0, noise) {}

  void add(Film& film, float (*e)(int x), Film* without = nullptr) {
    RgbImage u, f;
    u.reset(kSide, kSide), f.reset(kSide, kSide);
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) set(u, x, y, e(x) + normal_(random_));
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) set(f, x, y, filtered(u, x, y));
    film.addTile(0, 0, u, &f);
    film.frameDone();
    if (without != nullptr) without->add(u);
  }

 private:
  std::mt19937 random_;
  std::normal_distribution<float> normal_;
};

constexpr FilmKeeps kBoth{.pattern = {3, 3}};

double squaredError(const Film& film, size_t pixel) {
  return std::pow(static_cast<double>(film.standardError(pixel, film.frames())), 2);
}

// Mean of f(x, y) over the columns first ... last.
template <typename F>
double meanOver(int first, int last, const F& f) {
  double sum = 0;
  for (int y = 0; y < kSide; ++y)
    for (int x = first; x <= last; ++x) sum += static_cast<double>(f(x, y));
  return sum / ((last - first + 1) * kSide);
}

TEST(NeighbourShare, LeavesAConstantAsItIs) {
  Film film(kSide, kSide, kBoth);
  RgbImage same, mean;
  same.reset(kSide, kSide);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) set(same, x, y, 0.1f);
  for (int n = 0; n < 20; ++n) film.addTile(0, 0, same, &same), film.frameDone();
  film.mean(mean);
  EXPECT_TRUE(mean == same);
  EXPECT_EQ(film.standardError()[7], 0);
  EXPECT_EQ(film.relativeError(), 0);
}

TEST(NeighbourShare, FiltersFullyBeforeItCanTell) {
  Film film(kSide, kSide, kBoth);
  Frames frames(1, 0);
  for (int n = 0; n < NeighbourShare::kFirst - 1; ++n) frames.add(film, edge);
  RgbImage mean;
  film.mean(mean);
  EXPECT_NEAR(mean.rgb(mean.at(kSide / 2, 5)).x, 11 - 1 / 3.0f, 1e-5);
}

// 1/9 of the variance of U, and it says so.
TEST(NeighbourShare, KeepsAllOfTheFilterInFlatPlaces) {
  constexpr int kFilms = 10, kFrames = 64;
  double real = 0, stated = 0;
  for (unsigned f = 0; f < kFilms; ++f) {
    Film film(kSide, kSide, kBoth);
    Frames frames(10 + f);
    for (int n = 0; n < kFrames; ++n) frames.add(film, flat);
    film.updateShare();
    RgbImage mean;
    film.mean(mean);
    real += meanOver(1, kSide - 2,
                     [&](int x, int y) { return std::pow(mean.rgb(mean.at(x, y)).x - 10, 2); }) /
            kFilms;
    stated +=
        meanOver(1, kSide - 2, [&](int x, int y) { return squaredError(film, mean.at(x, y)); }) /
        kFilms;
  }
  EXPECT_NEAR(real * 9 * kFrames, 1, 0.15);
  EXPECT_NEAR(stated / real, 1, 0.15);
}

// The columns beside an edge of E lose a third of its height to the filter. What is left of that
// falls as a does, as 1/N.
TEST(NeighbourShare, TendsToTheTruthWhereTheFilterBlurs) {
  Film film(kSide, kSide, kBoth), without(kSide, kSide);
  Frames frames(3, 0.1f);
  double blur[2] = {};
  for (int n = 1; n <= 256; ++n) {
    frames.add(film, edge, &without);
    if (n != 16 && n != 256) continue;
    RgbImage mean, u;
    film.mean(mean), without.mean(u);
    blur[n == 256] = meanOver(kSide / 2, kSide / 2, [&](int x, int y) {
      return u.rgb(u.at(x, y)).x - mean.rgb(mean.at(x, y)).x;
    });
  }
  EXPECT_LT(blur[0], 0.01);
  EXPECT_NEAR(blur[0] / blur[1], 16, 4);
}

// Parts have a of the last update; the whole has it anew.
TEST(NeighbourShare, OfPartsIsUpdatedAsTheFilmGrows) {
  Film film(kSide, kSide, kBoth);
  Frames frames(5, 0.1f);
  RgbImage whole, part;
  part.reset(kSide, kSide);
  for (int n = 1; n <= 20; ++n) {
    frames.add(film, edge);
    film.updateShare();
    film.mean(whole);
    film.meanOfTile({0, 0, kSide, kSide}, part);
    const bool isUpdated = n <= 16 || n % 2 == 0;  // from 16 on two frames are an eighth
    EXPECT_EQ(part == whole, isUpdated) << n;
  }
}

// Of weak edges, too: noise and blur together are what the film states for the columns beside it.
TEST(NeighbourShare, StatesTheBlurThatIsLeft) {
  constexpr int kFilms = 20, kFrames = 64;
  for (const float noise : {0.1f, 0.5f}) {
    double real = 0, stated = 0;
    for (unsigned f = 0; f < kFilms; ++f) {
      Film film(kSide, kSide, kBoth);
      Frames frames(100 + f, noise);
      for (int n = 0; n < kFrames; ++n) frames.add(film, edge);
      film.updateShare();
      RgbImage mean;
      film.mean(mean);
      real += meanOver(kSide / 2 - 1, kSide / 2, [&](int x, int y) {
        return std::pow(mean.rgb(mean.at(x, y)).x - edge(x), 2);
      });
      stated += meanOver(kSide / 2 - 1, kSide / 2,
                         [&](int x, int y) { return squaredError(film, mean.at(x, y)); });
    }
    EXPECT_NEAR(stated / real, 1, 0.2) << noise;
  }
}

// Blocks' means: the filter moves light between pixels, so their error is that of U.
TEST(NeighbourShare, StatesTheErrorOfBlocks) {
  constexpr int kFilms = 60, kFrames = 32;
  double real = 0, stated = 0, image = 0;
  for (unsigned f = 0; f < kFilms; ++f) {
    Film film(kSide, kSide, kBoth);
    Frames frames(200 + f, 0.5f);
    for (int n = 0; n < kFrames; ++n) frames.add(film, edge);
    RgbImage mean;
    film.mean(mean);
    for (int b = 0; b < 3; ++b) {
      double off = 0;
      for (int y = 0; y < 16; ++y)
        for (int x = 16 * b; x < 16 * b + 16; ++x)
          off += static_cast<double>(mean.rgb(mean.at(x, y)).x - edge(x)) / 256;
      real += off * off / 3;
    }
    stated += std::pow(film.relativeError() * 10.5, 2);
    image += std::pow(film.imageRelativeError() * 10.5, 2);
  }
  EXPECT_NEAR(stated / real, 1, 0.3);
  EXPECT_NEAR(image / stated, 1.0 / 9, 0.03);
}

}  // namespace
}  // namespace ninefold
