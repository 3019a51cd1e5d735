// Light and pixel samplers: every block, every union of blocks and every padded replication is a
// net, and a sample depends on nothing but its address.
#include "common/sampling/sampler.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>

#include "tests/sampling/chi_square.h"
#include "tests/sampling/nets.h"

namespace ninefold {
namespace {

constexpr Randomization kBoth[] = {Randomization::exclusiveOr, Randomization::owen};
constexpr Randomization kAll[] = {Randomization::exclusiveOr, Randomization::owen,
                                  Randomization::random};

// The points of `count` sets from `first` on, in the first `s` dimensions of replication `group`.
PointSet lightPoints(uint32_t first, uint32_t count, int m, uint32_t group, uint32_t s,
                     Randomization kind, uint32_t randomization = 3) {
  PointSet points(s);
  for (uint32_t set = first; set < first + count; ++set) {
    const LightSampler sampler(42, SampleUse::lightPath, randomization, set, m, kind);
    for (uint32_t i = 0; i < (1u << m); ++i) {
      for (uint32_t d = 0; d < s; ++d) {
        points[d].push_back(sampler.get1D(i, kSobolDimensions * group + d));
      }
    }
  }
  return points;
}

TEST(LightSampler, EveryBlockIsANetInEveryReplication) {
  for (const Randomization kind : kBoth) {
    for (const uint32_t group : {0u, 1u, 2u, 37u}) {
      for (const int m : {0, 1, 4, 7}) {
        for (uint32_t set = 0; set < 10; ++set) {
          EXPECT_TRUE(isNet(lightPoints(set, 1, m, group, 2, kind), 0)) << m << " set " << set;
          EXPECT_TRUE(isNet(lightPoints(set, 1, m, group, 4, kind), 3)) << m << " set " << set;
        }
      }
    }
  }
}

TEST(LightSampler, UnionsOfTwoToTheJBlocksAreNetsToo) {
  for (const Randomization kind : kBoth) {
    for (const uint32_t group : {0u, 1u, 5u}) {
      for (uint32_t j = 1; j <= 4; ++j) {
        for (const uint32_t first : {0u, 1u << j, 6u << j}) {
          EXPECT_TRUE(isNet(lightPoints(first, 1u << j, 3, group, 2, kind), 0)) << j;
          EXPECT_TRUE(isNet(lightPoints(first, 1u << j, 3, group, 4, kind), 3)) << j;
        }
      }
    }
  }
}

TEST(LightSampler, SamplesDoNotDependOnTheOrderOfAsking) {
  for (const Randomization kind : kAll) {
    const LightSampler sampler(1, SampleUse::photon, 9, 4, 6, kind);
    std::map<std::pair<uint32_t, uint32_t>, float> forward;
    for (uint32_t i = 0; i < 64; ++i) {
      for (uint32_t d = 0; d < 24; ++d) forward[{i, d}] = sampler.get1D(i, d);
    }
    for (uint32_t d = 24; d-- > 0;) {
      for (uint32_t i = 64; i-- > 0;) {
        const LightSampler again(1, SampleUse::photon, 9, 4, 6, kind);
        EXPECT_EQ(again.get1D(i, d), (forward[{i, d}]));
        if (d % 2 == 0) {
          EXPECT_EQ(again.get2D(i, d), Vec2(forward[{i, d}], forward[{i, d + 1}]));
        }
      }
    }
  }
}

TEST(LightSampler, TheLastBlockOfTheSequenceIsANet) {
  for (const Randomization kind : kBoth) {
    const uint32_t last = (1u << 24) - 1;  // of blocks of 2^8 points: ends at index 2^32 - 1
    EXPECT_TRUE(isNet(lightPoints(last, 1, 8, 0, 2, kind), 0));
    EXPECT_TRUE(isNet(lightPoints(last, 1, 8, 3, 2, kind), 0));
  }
  const LightSampler whole(1, SampleUse::lightPath, 0, 0, 32, Randomization::owen);
  EXPECT_LT(whole.get1D(0xffffffffu, 5), 1.0f);
}

// Correlation of two samples over many indices; 0 for independent ones, with deviation 1/sqrt(n).
double correlation(uint32_t n, const std::function<Vec2(uint32_t)>& pair) {
  double xy = 0;
  for (uint32_t i = 0; i < n; ++i) {
    const Vec2 p = pair(i);
    xy += 12.0 * (p.x - 0.5) * (p.y - 0.5);
  }
  return xy / n;
}

// Padding must not repeat the first dimensions, not even up to an exclusive-or: two samples that
// share a sixteenth of dimension `a` meet by chance only, once in 16 times, in a dimension of
// another replication.
double meetings(const LightSampler& sampler, uint32_t a, uint32_t b) {
  std::vector<std::pair<int, int>> cells;
  for (uint32_t i = 0; i < 256; ++i) {
    cells.emplace_back(16 * sampler.get1D(i, a), 16 * sampler.get1D(i, b));
  }
  int pairs = 0, met = 0;
  for (size_t i = 0; i < cells.size(); ++i) {
    for (size_t k = i + 1; k < cells.size(); ++k) {
      if (cells[i].first != cells[k].first) continue;
      ++pairs;
      met += cells[i].second == cells[k].second;
    }
  }
  return double(met) / pairs;
}

TEST(LightSampler, ReplicationsAreNotShiftsOfEachOther) {
  for (const Randomization kind : kAll) {
    for (const auto& [a, b] : {std::pair{0u, 4u}, {1u, 5u}, {4u, 8u}, {2u, 6u}, {0u, 12u}}) {
      double mean = 0, product = 0;
      constexpr uint32_t kRandomizations = 100;
      for (uint32_t r = 0; r < kRandomizations; ++r) {
        const LightSampler sampler(7, SampleUse::lightPath, r, 2, 8, kind);
        mean += meetings(sampler, a, b) / kRandomizations;
        product += correlation(256,
                               [&, a = a, b = b](uint32_t i) {
                                 return Vec2(sampler.get1D(i, a), sampler.get1D(i, b));
                               }) /
                   kRandomizations;
      }
      EXPECT_NEAR(mean, 1.0 / 16, 0.004) << "dimensions " << a << ", " << b;
      EXPECT_NEAR(product, 0, 0.03) << "dimensions " << a << ", " << b;
    }
  }
}

TEST(LightSampler, OtherAddressesGiveOtherSamples) {
  const auto first = [](uint64_t seed, SampleUse use, uint32_t randomization) {
    return LightSampler(seed, use, randomization, 0, 4, Randomization::owen).get1D(0, 0);
  };
  const float base = first(1, SampleUse::lightPath, 0);
  EXPECT_NE(base, first(2, SampleUse::lightPath, 0));
  EXPECT_NE(base, first(1, SampleUse::photon, 0));
  EXPECT_NE(base, first(1, SampleUse::lightPath, 1));
}

// Over the frames each sample is uniform, so that any estimate has the right mean.
TEST(LightSampler, EachSampleIsUniformOverRandomizations) {
  for (const Randomization kind : kAll) {
    for (const uint32_t dimension : {0u, 3u, 6u}) {
      std::vector<int> counts(16);
      for (uint32_t r = 0; r < 16000; ++r) {
        const LightSampler sampler(5, SampleUse::lightPath, r, 1, 3, kind);
        ++counts[static_cast<size_t>(16 * sampler.get1D(5, dimension))];
      }
      double chi2 = 0;
      for (const int c : counts) chi2 += (c - 1000.0) * (c - 1000.0) / 1000.0;
      EXPECT_LT(chi2, 44.3) << dimension;  // 15 degrees of freedom, p = 1e-4
    }
  }
}

// Points that know nothing of each other: how many of 16 fall into a half is binomial, with
// variance 16/4; of a net exactly 8 do. The tolerance is five standard deviations of the variance's
// estimate.
TEST(LightSampler, RandomPointsAreIndependent) {
  for (const uint32_t dimension : {0u, 3u, 6u}) {
    double variance = 0;
    constexpr uint32_t kBlocks = 4000;
    for (uint32_t r = 0; r < kBlocks; ++r) {
      const LightSampler sampler(5, SampleUse::photon, r, 1, 4, Randomization::random);
      int low = 0;
      for (uint32_t i = 0; i < 16; ++i) low += sampler.get1D(i, dimension) < 0.5f;
      variance += (low - 8.0) * (low - 8.0) / kBlocks;
    }
    EXPECT_NEAR(variance, 4, 0.45) << dimension;
  }
}

TEST(PixelSampler, EveryAlignedRunOfPathsOfAFrameIsANetInEveryReplication) {
  for (const Randomization kind : kBoth) {
    for (const uint32_t group : {0u, 1u, 9u}) {
      for (const uint32_t first : {0u, 64u, 4032u, 0xffffffc0u}) {
        PointSet points(4);
        for (uint32_t i = 0; i < 64; ++i) {
          const PixelSampler sampler(PixelStream(3, SampleUse::eyePath, 5, 1, kind), 11, 470,
                                     first + i);
          for (uint32_t d = 0; d < 4; d += 2) {
            const Vec2 p = sampler.get2D(kSobolDimensions * group + d);
            points[d].push_back(p.x);
            points[d + 1].push_back(p.y);
          }
        }
        EXPECT_TRUE(isNet({points[0], points[1]}, 0)) << group;
        EXPECT_TRUE(isNet(points, 3)) << group;
      }
    }
  }
}

// Frames that are a whole number of replications apart go on where the last one stopped: 64 paths
// of 16 or 64 such frames are a net.
TEST(PixelSampler, EveryEighthFrameContinuesOneSequence) {
  for (const Randomization kind : kBoth)
    for (const uint32_t paths : {1u, 4u})
      for (const uint32_t replication : {0u, 5u}) {
        PointSet points(2);
        for (uint32_t i = 0; i < 64; ++i) {
          const uint32_t frame = replication + kReplications * (i / paths);
          const Vec2 p = PixelSampler(PixelStream(3, SampleUse::eyePath, frame, paths, kind), 11,
                                      470, i % paths)
                             .get2D(0);
          points[0].push_back(p.x), points[1].push_back(p.y);
        }
        EXPECT_TRUE(isNet(points, 0)) << paths << " paths, replication " << replication;
      }
}

// What the film's standard error rests on: a pixel's samples in one replication say nothing of
// those of another, and each alone is uniform. In 8 x 8 cells of the square, 20,000 pixels:
// Pearson's statistic.
TEST(PixelSampler, ReplicationsAreIndependentAndUniform) {
  constexpr uint32_t kPixels = 20000;
  for (const Randomization kind : kAll) {
    for (const uint32_t dimension : {0u, 2u, 8u}) {
      const auto sample = [&](uint32_t pixel, uint32_t frame) {
        return PixelSampler(PixelStream(3, SampleUse::eyePath, frame, 1, kind), pixel % 200,
                            pixel / 200, 0)
            .get2D(dimension);
      };
      const std::vector<double> expected(64, kPixels / 64.0);
      std::vector<double> within(64), across(64);
      for (uint32_t pixel = 0; pixel < kPixels; ++pixel) {
        const Vec2 u = sample(pixel, 42);
        const float next = sample(pixel, 43).x;
        ++within[static_cast<size_t>(8 * u.x) + 8 * static_cast<size_t>(8 * u.y)];
        ++across[static_cast<size_t>(8 * u.x) + 8 * static_cast<size_t>(8 * next)];
      }
      EXPECT_GT(chiSquareP(within, expected), sidak(0.01, 18)) << dimension;
      EXPECT_GT(chiSquareP(across, expected), sidak(0.01, 18)) << dimension;
    }
  }
}

TEST(PixelSampler, NeighbouringPixelsAreUncorrelated) {
  for (const Randomization kind : kAll) {
    const auto sample = [&](uint32_t x, uint32_t y, uint32_t d) {
      return PixelSampler(PixelStream(3, SampleUse::eyePath, 0, 1, kind), x, y, 0).get1D(d);
    };
    constexpr uint32_t kPixels = 20000;
    const auto apart = [&](uint32_t dx, uint32_t dy, uint32_t d) {
      return correlation(kPixels, [&](uint32_t i) {
        return Vec2(sample(i % 200, i / 200, 0), sample(i % 200 + dx, i / 200 + dy, d));
      });
    };
    for (const uint32_t d : {0u, 1u, 4u}) {
      EXPECT_LT(std::abs(apart(1, 0, d)), 0.035);  // five standard deviations
      EXPECT_LT(std::abs(apart(0, 1, d)), 0.035);
    }
  }
}

TEST(UnitFloat, NeverReachesOne) {
  EXPECT_EQ(unitFloat(0), 0.0f);
  EXPECT_EQ(unitFloat(0xffffffffu), 1.0f - 0x1p-24f);
}

}  // namespace
}  // namespace ninefold
