#include "common/image/radius_bias.h"

#include <array>
#include <bit>
#include <numeric>

namespace ninefold {
namespace {

constexpr size_t kHalves = 35;
using Squares = std::array<double, kHalves>;  // D_s^2; the first s is the true one

// Even frames have the wider radius; of two complements the one with replication 0 stands for both.
constexpr std::array<uint8_t, kHalves> halves() {
  std::array<uint8_t, kHalves> all{0b01010101};
  size_t count = 1;
  for (unsigned s = 1; s < 256; s += 2)
    if (std::popcount(s) == 4 && s != all[0]) all[count++] = static_cast<uint8_t>(s);
  return all;
}

Squares differences(const Replications<double>& blocks, size_t block) {
  static constexpr auto kAll = halves();
  Squares squares{};
  for (size_t s = 0; s < kHalves; ++s) {
    double d = 0;
    for (size_t r = 0; r < kReplications; ++r)
      d += (kAll[s] >> r & 1) != 0 ? blocks.at(r, block) : -blocks.at(r, block);
    squares[s] = d * d / 16;
  }
  return squares;
}

double squaredBias(const Squares& squares) {
  constexpr double kFactor = 2.25 / (1 - 2.0 / 17);
  const double others = std::accumulate(squares.begin() + 1, squares.end(), 0.0) / (kHalves - 1);
  return kFactor * (squares[0] - others);
}

}  // namespace

RadiusBias RadiusBias::of(const Replications<double>& blocks, std::span<const double> pixels,
                          int64_t frames) {
  RadiusBias bias;
  if (frames < kReplications) return bias;
  Squares sum{};
  double weight = 0;
  for (size_t b = 0; b < pixels.size(); ++b) {
    const Squares squares = differences(blocks, b);
    for (size_t s = 0; s < kHalves; ++s) sum[s] += pixels[b] * squares[s];
    weight += pixels[b];
    bias.squares.push_back(std::max(squaredBias(squares), 0.0));
  }
  if (!(sum[0] > *std::max_element(sum.begin() + 1, sum.end()))) return {};
  bias.squared = squaredBias(sum) / weight;
  return bias;
}

}  // namespace ninefold
