// replay.cpp: runs a fuzz target without libFuzzer: a fixed, seeded number of mutations of its
// seeds, or the files named on the command line (to look at what libFuzzer found).
// NINEFOLD_TEST_SEED=17 runs mutation 17 alone.
//
//   fuzz_<name> [FILE...]
//   fuzz_<name> --seeds FOLDER       writes the seeds there, for libFuzzer to begin with
//
// Deterministic: the same inputs in every run. When one goes wrong, its number is printed.
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <string_view>

#include "tests/fuzz/fuzz.h"

namespace {

using Input = std::vector<uint8_t>;

constexpr int kMutations = 2000;
volatile std::sig_atomic_t current = 0;
const char* program = "";

void onFailure(int signal) {
  const int input = current;
  std::fprintf(stderr, "input %d failed; again: NINEFOLD_TEST_SEED=%d %s\n", input, input, program);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

class Mutator {
 public:
  explicit Mutator(std::vector<Input> seeds) : seeds_(std::move(seeds)) {}

  // Mutation i of one of the seeds: 0 to 8 small changes.
  Input operator()(int i) {
    random_.seed(static_cast<uint32_t>(i));
    Input input = seeds_[pick(seeds_.size())];
    for (size_t changes = pick(9); changes > 0 && !input.empty(); --changes) change(input);
    return input;
  }

 private:
  size_t pick(size_t n) { return random_() % n; }

  void change(Input& input) {
    const size_t at = pick(input.size());
    const auto place = input.begin() + static_cast<ptrdiff_t>(at);
    switch (pick(7)) {
      case 0:
        input[at] = static_cast<uint8_t>(random_());
        break;
      case 1:
        input[at] ^= static_cast<uint8_t>(1u << pick(8));
        break;
      case 2:
        input.resize(at);
        break;
      case 3:
        input.erase(place, place + static_cast<ptrdiff_t>(
                                       1 + pick(std::min<size_t>(16, input.size() - at))));
        break;
      case 4:
        input.insert(place, 1 + pick(16), static_cast<uint8_t>(random_()));
        break;
      case 5:
        overwrite(input, at);
        break;
      default:
        splice(input, at);
        break;
    }
  }

  // A number that is often a special case.
  void overwrite(Input& input, size_t at) {
    constexpr uint64_t kSpecial[] = {0,      1,          0x7F,       0xFF,        0x7FFF,
                                     0xFFFF, 0x7FFFFFFF, 0xFFFFFFFF, ~uint64_t{0}};
    const uint64_t value = kSpecial[pick(std::size(kSpecial))];
    const size_t bytes = std::min<size_t>(input.size() - at, size_t{1} << pick(4));
    for (size_t b = 0; b < bytes; ++b) input[at + b] = static_cast<uint8_t>(value >> 8 * b);
  }

  // A piece of some seed.
  void splice(Input& input, size_t at) {
    const Input& other = seeds_[pick(seeds_.size())];
    if (other.empty()) return;
    const size_t from = pick(other.size());
    const size_t length = 1 + pick(std::min<size_t>(64, other.size() - from));
    const auto begin = other.begin() + static_cast<ptrdiff_t>(from);
    input.insert(input.begin() + static_cast<ptrdiff_t>(at), begin,
                 begin + static_cast<ptrdiff_t>(length));
  }

  std::vector<Input> seeds_;
  std::mt19937 random_;
};

std::vector<Input> randomSeeds() {
  std::mt19937 random(1);
  std::vector<Input> seeds;
  for (const size_t size : {1, 7, 40, 300, 2000}) {
    Input& seed = seeds.emplace_back(size);
    for (uint8_t& byte : seed) byte = static_cast<uint8_t>(random());
  }
  return seeds;
}

int replayFiles(int count, char** files) {
  for (int i = 0; i < count; ++i) {
    std::ifstream file(files[i], std::ios::binary);
    const Input input((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    LLVMFuzzerTestOneInput(input.data(), input.size());
  }
  return 0;
}

int writeSeeds(const std::string& folder) {
  int number = 0;
  for (const Input& seed : ninefoldFuzzSeeds()) {
    std::ofstream file(folder + "/seed" + std::to_string(number++), std::ios::binary);
    file.write(reinterpret_cast<const char*>(seed.data()),
               static_cast<std::streamsize>(seed.size()));
    if (!file.flush()) return std::fprintf(stderr, "%s: cannot write there\n", folder.c_str()), 1;
  }
  return 0;
}

}  // namespace

// Replaced by the target's own, if it has one.
__attribute__((weak)) std::vector<std::vector<uint8_t>> ninefoldFuzzSeeds() {
  return randomSeeds();
}

int main(int argc, char** argv) {
  if (argc == 3 && argv[1] == std::string_view("--seeds")) return writeSeeds(argv[2]);
  if (argc > 1) return replayFiles(argc - 1, argv + 1);
  for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL})
    std::signal(signal, onFailure);
  program = argv[0];
  const char* asked = std::getenv("NINEFOLD_TEST_SEED");
  const int first = asked != nullptr ? std::atoi(asked) : 0;
  Mutator mutate(ninefoldFuzzSeeds());
  for (int i = first; i < (asked != nullptr ? first + 1 : kMutations); ++i) {
    current = i;
    const Input input = mutate(i);
    LLVMFuzzerTestOneInput(input.data(), input.size());
  }
  return 0;
}
