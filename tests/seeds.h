// seeds.h: the seeds of a randomized test, and the command that repeats one of them.
//
//   for (const uint64_t seed : seedsFrom(1, 60)) {
//     const Repeatable repeatable(seed);
//     ...
//
// NINEFOLD_TEST_SEED=17 makes 17 the only seed, of all randomized tests that are run. While a
// Repeatable lives, a failure says the command that repeats it, and so does an abort
// (NINEFOLD_CHECK).
// Threads: one Repeatable at a time, in the test's own thread.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace ninefold {

inline std::vector<uint64_t> seedsFrom(uint64_t first, uint64_t last) {
  if (const char* asked = std::getenv("NINEFOLD_TEST_SEED"))
    return {std::strtoull(asked, nullptr, 10)};
  std::vector<uint64_t> seeds;
  for (uint64_t seed = first; seed <= last; ++seed) seeds.push_back(seed);
  return seeds;
}

class Repeatable {
 public:
  explicit Repeatable(uint64_t seed)
      : trace_(__FILE__, __LINE__, "again: " + commandFor(seed)),
        before_(std::signal(SIGABRT, [](int) {
          (void)!::write(STDERR_FILENO, line_.data(), line_.size());
          std::signal(SIGABRT, SIG_DFL);
          std::raise(SIGABRT);
        })) {
    line_ = "again: " + commandFor(seed) + "\n";
  }
  ~Repeatable() { std::signal(SIGABRT, before_); }
  Repeatable(const Repeatable&) = delete;
  Repeatable& operator=(const Repeatable&) = delete;

  static std::string commandFor(uint64_t seed) {
    const ::testing::TestInfo& test = *::testing::UnitTest::GetInstance()->current_test_info();
    return fmt::format("NINEFOLD_TEST_SEED={} {} --gtest_filter={}.{}", seed,
                       std::filesystem::read_symlink("/proc/self/exe").string(),
                       test.test_suite_name(), test.name());
  }

 private:
  static inline std::string line_;
  const ::testing::ScopedTrace trace_;
  void (*before_)(int);
};

}  // namespace ninefold
