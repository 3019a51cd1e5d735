// The bias of the photons' radius, seen by frames that take two radii by turns. Films of one pixel
// a block here, so that blocks are what frames say.
//
// With bias w in even frames and w/2 in odd ones, the mean over both is 3/4 w off: that is what
// must be stated. Without bias the image is said to have one in one film of 35, whatever its blocks
// share.
#include "common/image/radius_bias.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace ninefold {
namespace {

constexpr size_t kBlocks = 60;
const std::vector<double> kPixels(kBlocks, 256.0);

// Frames of normal noise of deviation 1 a block, as much that all blocks share, and a bias.
RadiusBias biasOfFilm(unsigned seed, int frames, double wide) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Replications<double> blocks;
  blocks.resize(kBlocks);
  for (int f = 0; f < frames; ++f) {
    const double shared = normal(random);
    std::vector<double> values(kBlocks);
    for (double& v : values) v = normal(random) + shared + (f % 2 == 0 ? wide : wide / 2);
    blocks.add(values, 0, f);
  }
  return RadiusBias::of(blocks, kPixels, frames);
}

TEST(RadiusBias, IsThreeQuartersOfTheWiderRadius) {
  constexpr int kFilms = 200;
  for (const double wide : {4.0, 16.0}) {  // so much that chance does not hide it
    double sum = 0, ofBlocks = 0;
    for (int film = 0; film < kFilms; ++film) {
      const RadiusBias bias = biasOfFilm(static_cast<unsigned>(film), 64, wide);
      sum += bias.squared;
      for (const double b : bias.squares) ofBlocks += b / kBlocks;
    }
    const double expected = 0.75 * wide;
    // D has a variance of 4 (1 + 1)/64: a film's B^2 spreads by 2 B (3/2) sqrt(1/8) or so.
    EXPECT_NEAR(std::sqrt(sum / kFilms), expected, 0.1) << wide;
    // Nothing is below 0 there.
    EXPECT_NEAR(std::sqrt(ofBlocks / kFilms), expected, 0.15) << wide;
  }
}

TEST(RadiusBias, IsRarelySeenWhereThereIsNone) {
  constexpr int kFilms = 700;
  for (const int frames : {8, 12, 16, 64}) {
    int seen = 0;
    for (int film = 0; film < kFilms; ++film)
      seen += biasOfFilm(1000u + static_cast<unsigned>(film), frames, 0).squared > 0 ? 1 : 0;
    // 20 of 700, with a deviation of 4.4.
    EXPECT_NEAR(seen, kFilms / 35, 4 * 4.4) << frames;
  }
}

TEST(RadiusBias, IsUnknownBeforeAllReplicationsHaveAFrame) {
  EXPECT_EQ(biasOfFilm(1, 7, 100).squared, 0);
  EXPECT_GT(biasOfFilm(1, 8, 100).squared, 0);
}

// Frames that are all alike have no bias, and no noise to compare it with.
TEST(RadiusBias, IsNoneOfFramesThatAreAlike) {
  Replications<double> blocks;
  blocks.resize(kBlocks);
  const std::vector<double> values(kBlocks, 0.3);
  for (int f = 0; f < 16; ++f) blocks.add(values, 0, f);
  const RadiusBias bias = RadiusBias::of(blocks, kPixels, 16);
  EXPECT_EQ(bias.squared, 0);
  EXPECT_TRUE(bias.squares.empty());
}

}  // namespace
}  // namespace ninefold
