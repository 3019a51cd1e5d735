#include "common/image/agx.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

namespace ninefold {
namespace {

constexpr double kLeastEv = -12.47393, kEvRange = 16.5;  // of v, log2

// Rows of the inset, and of what undoes the outset.
constexpr float kInset[3][3] = {{0.842479062253094f, 0.0784335999999992f, 0.0792237451477643f},
                                {0.0423282422610123f, 0.878468636469772f, 0.0791661274605434f},
                                {0.0423756549057051f, 0.0784336f, 0.879142973793104f}};
constexpr float kOutset[3][3] = {{1.19687900512017f, -0.0980208811401368f, -0.0990297440797205f},
                                 {-0.0528968517574562f, 1.15190312990417f, -0.0989611768448433f},
                                 {-0.0529716355144438f, -0.0980434501171241f, 1.15107367264116f}};

double contrast(double t) {
  constexpr double k[] = {-0.00232, 0.1191, 0.4298, -6.868, 31.96, -40.14, 15.5};
  double sum = 0;
  for (int i = 6; i >= 0; --i) sum = sum * t + k[i];
  return sum;
}

// c over v: cells are floats from 2^-13 to 2^5, 10 bits of each binade.
constexpr int kLowExponent = -13, kHighExponent = 5, kShift = 13;
constexpr uint32_t kFirstCell = uint32_t(127 + kLowExponent) << 10;
constexpr uint32_t kCells = uint32_t(kHighExponent - kLowExponent) << 10;

std::vector<float> makeTable() {
  std::vector<float> table;
  table.reserve(kCells);
  for (uint32_t cell = 0; cell < kCells; ++cell) {
    const uint32_t middle = ((kFirstCell + cell) << kShift) + (1u << (kShift - 1));
    const auto v = static_cast<double>(std::bit_cast<float>(middle));
    const double c = contrast(std::clamp((std::log2(v) - kLeastEv) / kEvRange, 0.0, 1.0));
    table.push_back(static_cast<float>(std::round(65536 * c) / 65536));
  }
  return table;
}

float contrastOf(float v) {
  static const std::vector<float> table = makeTable();
  constexpr float kLow = 1.0f / (1 << -kLowExponent);
  const uint32_t cell = std::bit_cast<uint32_t>(v > kLow ? v : kLow) >> kShift;
  return table[std::min(cell, kFirstCell + kCells - 1) - kFirstCell];
}

float row(const float (&m)[3], Vec3 v) { return m[0] * v.x + m[1] * v.y + m[2] * v.z; }

}  // namespace

std::array<uint8_t, 3> agxCodes(Vec3 x) {
  const auto positive = [](float v) { return v > 0 ? v : 0.0f; };
  x = Vec3(positive(x.x), positive(x.y), positive(x.z));
  const Vec3 c(contrastOf(row(kInset[0], x)), contrastOf(row(kInset[1], x)),
               contrastOf(row(kInset[2], x)));
  std::array<uint8_t, 3> codes;
  for (size_t i = 0; i < 3; ++i)
    codes[i] = static_cast<uint8_t>(255 * std::clamp(row(kOutset[i], c), 0.0f, 1.0f) + 0.5f);
  return codes;
}

}  // namespace ninefold
