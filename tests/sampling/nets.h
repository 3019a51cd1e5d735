// nets.h: the defining property of a (t,m,s)-net in base 2, for tests of points and samplers.
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

namespace ninefold {

// Points stored dimension by dimension: points[d][i] in [0, 1).
using PointSet = std::vector<std::vector<float>>;

// Whether all boxes whose side in dimension d is 2^-splits[d] hold the same number of points.
inline bool boxesAreEquallyFull(const PointSet& points, const std::vector<int>& splits) {
  const int bits = std::accumulate(splits.begin(), splits.end(), 0);
  std::vector<uint32_t> counts(size_t{1} << bits);
  for (size_t i = 0; i < points[0].size(); ++i) {
    size_t box = 0;
    for (size_t d = 0; d < points.size(); ++d) {
      const float cells = static_cast<float>(1u << splits[d]);
      box = (box << splits[d]) | static_cast<size_t>(points[d][i] * cells);
    }
    ++counts[box];
  }
  const size_t expected = points[0].size() >> bits;
  for (const uint32_t count : counts) {
    if (count != expected) return false;
  }
  return true;
}

// All ways to split an elementary interval of volume 2^-bits over the dimensions from `d` on.
template <typename Check>
bool everySplit(std::vector<int>& splits, size_t d, int bits, const Check& check) {
  if (d + 1 == splits.size()) {
    splits[d] = bits;
    return check(splits);
  }
  for (int b = 0; b <= bits; ++b) {
    splits[d] = b;
    if (!everySplit(splits, d + 1, bits - b, check)) return false;
  }
  return true;
}

// Whether 2^m points are a (t,m,s)-net: elementary intervals of volume 2^(t-m) hold 2^t of them.
inline bool isNet(const PointSet& points, int t) {
  int m = 0;
  while ((size_t{1} << m) < points[0].size()) ++m;
  if (m <= t) return true;
  std::vector<int> splits(points.size());
  return everySplit(splits, 0, m - t,
                    [&](const std::vector<int>& s) { return boxesAreEquallyFull(points, s); });
}

}  // namespace ninefold
