#include "common/image/film_blocks.h"

#include <algorithm>

#include "common/base/error.h"
#include "common/image/image.h"

namespace ninefold {
namespace {

int ceilDivide(int a, int b) { return (a + b - 1) / b; }

}  // namespace

FilmBlocks::FilmBlocks(int width, int height)
    : width_(width),
      columns_(ceilDivide(width, kErrorBlock)),
      rows_(ceilDivide(height, kErrorBlock)),
      means_(pixelCount(columns_, rows_) + 1) {
  for (int y = 0; y < rows_; ++y)
    for (int x = 0; x < columns_; ++x)
      pixels_.push_back(std::min(kErrorBlock, width - x * kErrorBlock) *
                        std::min(kErrorBlock, height - y * kErrorBlock));
  pixels_.push_back(static_cast<double>(width) * height);
  clear();
}

void FilmBlocks::clear() { replications_.resize(means_.size()); }

// A row's blocks take turns: an addition has to wait for the one before it to the same sum.
void FilmBlocks::add(int x, int y, std::span<const float> luminance) {
  NINEFOLD_CHECK(x % kErrorBlock == 0);
  double* sum =
      &means_[pixelCount(columns_, y / kErrorBlock) + static_cast<size_t>(x / kErrorBlock)];
  const size_t n = luminance.size(), blocks = (n + kErrorBlock - 1) / kErrorBlock;
  if (y % kErrorBlock == 0) std::fill_n(sum, blocks, 0.0);
  for (size_t column = 0; column < kErrorBlock; ++column)
    for (size_t i = column; i < n; i += kErrorBlock)
      sum[i / kErrorBlock] += static_cast<double>(luminance[i]);
}

void FilmBlocks::frameDone(int64_t frame) {
  double whole = 0;
  for (size_t b = 0; b < count(); ++b) {
    whole += means_[b];
    means_[b] /= pixels_[b];
  }
  means_.back() = whole / pixels_.back();
  replications_.add(means_, 0, frame);
}

size_t FilmBlocks::blockOf(size_t pixel) const {
  const size_t x = pixel % static_cast<size_t>(width_), y = pixel / static_cast<size_t>(width_);
  return y / kErrorBlock * static_cast<size_t>(columns_) + x / kErrorBlock;
}

}  // namespace ninefold
