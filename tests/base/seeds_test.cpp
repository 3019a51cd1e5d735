// What a randomized test says when it fails: the command that repeats it, and that command's
// effect.
#include "tests/seeds.h"

#include <gtest/gtest-spi.h>

#include "common/base/error.h"

namespace ninefold {
namespace {

class OneSeed {
 public:
  explicit OneSeed(const char* seed) { ::setenv("NINEFOLD_TEST_SEED", seed, 1); }
  ~OneSeed() { ::unsetenv("NINEFOLD_TEST_SEED"); }
};

TEST(Seeds, AreAllThatWereNamedOrTheOneThatIsAskedFor) {
  ::unsetenv("NINEFOLD_TEST_SEED");
  EXPECT_EQ(seedsFrom(3, 5), (std::vector<uint64_t>{3, 4, 5}));
  const OneSeed asked("18446744073709551615");
  EXPECT_EQ(seedsFrom(3, 5), std::vector<uint64_t>{UINT64_MAX});
}

TEST(Seeds, AFailureNamesTheCommandThatRepeatsIt) {
  EXPECT_NONFATAL_FAILURE(
      {
        const Repeatable repeatable(17);
        ADD_FAILURE();
      },
      "/base_test --gtest_filter=Seeds.AFailureNamesTheCommandThatRepeatsIt");
  EXPECT_NONFATAL_FAILURE(
      {
        const Repeatable repeatable(17);
        ADD_FAILURE();
      },
      "again: NINEFOLD_TEST_SEED=17 /");
}

TEST(SeedsDeathTest, AnAbortNamesItToo) {
  const Repeatable repeatable(29);
  EXPECT_DEATH(NINEFOLD_CHECK(1 == 2), "1 == 2 does not hold(.|\n)*again: NINEFOLD_TEST_SEED=29 /");
}

}  // namespace
}  // namespace ninefold
