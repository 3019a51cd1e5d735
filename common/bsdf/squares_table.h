// squares_table.h: a function of two fractions in a table whose nodes are the squares of evenly
// spaced numbers, (i/(n-1))^2: denser near 0, where albedos rise steeply. Linear between them.
// Internal to common/bsdf.
// Threads: const after construction.   Errors: none; arguments are brought into [0, 1].
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace ninefold {

template <int kColumns, int kRows, typename Value = float>
class SquaresTable {
 public:
  // f(x, y) -> Value, asked at all nodes. Values add up and are multiplied by numbers.
  template <typename F>
  explicit SquaresTable(const F& f) {
    for (int j = 0; j < kRows; ++j)
      for (int i = 0; i < kColumns; ++i) at(i, j) = f(node(i, kColumns), node(j, kRows));
  }

  Value operator()(float x, float y) const {
    const Place c = place(x, kColumns), r = place(y, kRows);
    const auto row = [&](int j) { return mix(at(c.index, j), at(c.index + 1, j), c.part); };
    return mix(row(r.index), row(r.index + 1), r.part);
  }

 private:
  struct Place {
    int index;   // of the lower neighbour
    float part;  // of the upper one
  };
  static float node(int i, int nodes) {
    const float t = static_cast<float>(i) / static_cast<float>(nodes - 1);
    return t * t;
  }
  static Place place(float value, int nodes) {
    const float t = std::sqrt(std::clamp(value, 0.0f, 1.0f)) * static_cast<float>(nodes - 1);
    const int index = std::min(static_cast<int>(t), nodes - 2);
    return {index, t - static_cast<float>(index)};
  }
  static Value mix(Value a, Value b, float part) { return a + part * (b - a); }

  Value& at(int i, int j) { return values_[static_cast<size_t>(j * kColumns + i)]; }
  const Value& at(int i, int j) const { return values_[static_cast<size_t>(j * kColumns + i)]; }

  std::array<Value, static_cast<size_t>(kColumns* kRows)> values_{};
};

}  // namespace ninefold
