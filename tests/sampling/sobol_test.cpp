// Sobol' points by index: the published sequence, and its stratification in every aligned block.
#include "common/sampling/sobol.h"

#include <gtest/gtest.h>

#include <boost/random/sobol.hpp>

#include "common/sampling/sampler.h"
#include "tests/sampling/nets.h"

namespace ninefold {
namespace {

PointSet block(uint64_t first, int m, const std::vector<uint32_t>& dimensions) {
  PointSet points(dimensions.size());
  for (size_t d = 0; d < dimensions.size(); ++d) {
    for (uint64_t i = 0; i < (uint64_t{1} << m); ++i) {
      points[d].push_back(unitFloat(sobolPoint(static_cast<uint32_t>(first + i), dimensions[d])));
    }
  }
  return points;
}

// Boost walks in Gray code order and starts at the second point.
TEST(Sobol, PointsAreThoseOfBoostRandom) {
  using Engine = boost::random::sobol_engine<uint32_t, 32>;
  Engine reference(kSobolDimensions);
  for (uint32_t step = 1; step < 5000; ++step) {
    const uint32_t gray = step ^ (step >> 1);
    for (uint32_t d = 0; d < kSobolDimensions; ++d) {
      ASSERT_EQ(sobolPoint(gray, d), reference()) << "point " << step << " dimension " << d;
    }
  }
}

TEST(Sobol, HighIndicesAreThoseOfBoostRandomToo) {
  using Engine = boost::random::sobol_engine<uint32_t, 32>;
  for (const uint32_t step : {0x7fffff00u, 0x80000010u, 0xdeadbeefu, 0xfffffff0u}) {
    Engine reference(kSobolDimensions);
    reference.seed(step);
    const uint32_t index = step + 1;
    for (uint32_t d = 0; d < kSobolDimensions; ++d) {
      ASSERT_EQ(sobolPoint(index ^ (index >> 1), d), reference()) << step << " dimension " << d;
    }
  }
}

TEST(Sobol, EveryAlignedBlockIsANet) {
  for (int m = 1; m <= 9; ++m) {
    for (const uint64_t k :
         {uint64_t{0}, uint64_t{1}, uint64_t{6}, (uint64_t{1} << (32 - m)) - 1}) {
      EXPECT_TRUE(isNet(block(k << m, m, {0, 1}), 0)) << "m " << m << " block " << k;
      EXPECT_TRUE(isNet(block(k << m, m, {0, 1, 2}), 1)) << "m " << m << " block " << k;
      EXPECT_TRUE(isNet(block(k << m, m, {0, 1, 2, 3}), 3)) << "m " << m << " block " << k;
      for (uint32_t d = 0; d < kSobolDimensions; ++d) {
        EXPECT_TRUE(isNet(block(k << m, m, {d}), 0)) << "m " << m << " dimension " << d;
      }
    }
  }
}

TEST(Sobol, ThePairOfDimensions2And3IsANetOfStatedQuality) {
  for (int m = 1; m <= 12; ++m) {
    EXPECT_TRUE(isNet(block(uint64_t{5} << m, m, {2, 3}), 2)) << "m " << m;
  }
}

}  // namespace
}  // namespace ninefold
