#include "common/image/film_layer.h"

#include "common/base/error.h"
#include "common/base/prefetch.h"

namespace ninefold {
namespace {

int ceilDivide(int a, int b) { return (a + b - 1) / b; }

// Adds values to running means, of which they are `share` from now on.
void addRow(const float* values, size_t n, double share, double* mean) {
#pragma GCC ivdep
  for (size_t i = 0; i < n; ++i) mean[i] += (static_cast<double>(values[i]) - mean[i]) * share;
}

// Rows of a tile are far apart in the film, where no processor looks ahead by itself.
constexpr int kRowsAhead = 2;

}  // namespace

FilmLayer::FilmLayer(int width, int height, bool keepsPixels)
    : width_(width),
      height_(height),
      blockColumns_(ceilDivide(width, kErrorBlock)),
      blockRows_(ceilDivide(height, kErrorBlock)) {
  blockMeans_.resize(pixelCount(blockColumns_, blockRows_) + 1);
  for (int by = 0; by < blockRows_; ++by)
    for (int bx = 0; bx < blockColumns_; ++bx)
      blockPixels_.push_back(std::min(kErrorBlock, width - bx * kErrorBlock) *
                             std::min(kErrorBlock, height - by * kErrorBlock));
  blockPixels_.push_back(static_cast<double>(width) * height);
  if (keepsPixels) pixels_.resize(pixelCount(width, height));
  clear();
}

void FilmLayer::clear() {
  const size_t pixels = pixelCount(width_, height_);
  for (auto* mean : {&r_, &g_, &b_}) mean->assign(pixels, 0);
  if (!pixels_.empty()) pixels_.resize(pixels);
  blocks_.resize(blockMeans_.size());
}

void FilmLayer::addTile(int x0, int y0, const RgbImage& tile, int64_t frame) {
  NINEFOLD_CHECK(x0 + tile.width <= width_);
  NINEFOLD_CHECK(y0 + tile.height <= height_);
  const double share = 1.0 / static_cast<double>(frame + 1);
  const auto width = static_cast<size_t>(tile.width);
  for (int y = 0; y < tile.height; ++y) {
    const size_t to = pixelCount(width_, y0 + y) + static_cast<size_t>(x0);
    const size_t from = tile.at(0, y);
    if (y + kRowsAhead < tile.height)
      for (const auto* means : {&r_, &g_, &b_})
        prefetch<Soon::isWritten>(means->data() + to + pixelCount(width_, kRowsAhead),
                                  width * sizeof(double));
    addRow(&tile.pixels.r[from], width, share, &r_[to]);
    addRow(&tile.pixels.g[from], width, share, &g_[to]);
    addRow(&tile.pixels.b[from], width, share, &b_[to]);
  }
  addLuminance(x0, y0, tile, frame);
}

// Adds to each pixel, and to the sums of the blocks, row by row within each block. A row's blocks
// take turns: an addition has to wait for the one before it to the same sum.
void FilmLayer::addLuminance(int x0, int y0, const RgbImage& tile, int64_t frame) {
  NINEFOLD_CHECK(x0 % kErrorBlock == 0);
  NINEFOLD_CHECK(y0 % kErrorBlock == 0);
  std::vector<float> row(static_cast<size_t>(tile.width));
  for (int y = 0; y < tile.height; ++y) {
    double* sum = &blockMeans_[pixelCount(blockColumns_, (y0 + y) / kErrorBlock) +
                               static_cast<size_t>(x0 / kErrorBlock)];
    if (y % kErrorBlock == 0) std::fill_n(sum, ceilDivide(tile.width, kErrorBlock), 0.0);
    for (size_t x = 0; x < row.size(); ++x) row[x] = luminance(tile.rgb(tile.at(0, y) + x));
    for (size_t column = 0; column < kErrorBlock; ++column)
      for (size_t x = column; x < row.size(); x += kErrorBlock)
        sum[x / kErrorBlock] += static_cast<double>(row[x]);
    const size_t to = pixelCount(width_, y0 + y) + static_cast<size_t>(x0);
    if (!pixels_.empty()) pixels_.add(row, to, frame);
  }
}

void FilmLayer::frameDone(int64_t frame) {
  double whole = 0;
  for (size_t b = 0; b + 1 < blockMeans_.size(); ++b) {
    whole += blockMeans_[b];
    blockMeans_[b] /= blockPixels_[b];
  }
  blockMeans_.back() = whole / blockPixels_.back();
  blocks_.add(blockMeans_, 0, frame);
}

void FilmLayer::write(const TaskRect& tile, RgbImage& out) const {
  for (int y = tile.j0; y < tile.j0 + tile.height; ++y) {
    const size_t begin = out.at(tile.i0, y), end = begin + static_cast<size_t>(tile.width);
    for (size_t i = begin; i < end; ++i) out.pixels.r[i] = static_cast<float>(r_[i]);
    for (size_t i = begin; i < end; ++i) out.pixels.g[i] = static_cast<float>(g_[i]);
    for (size_t i = begin; i < end; ++i) out.pixels.b[i] = static_cast<float>(b_[i]);
  }
}

void FilmLayer::add(const TaskRect& tile, const std::vector<float>& share, RgbImage& out) const {
  for (int y = tile.j0; y < tile.j0 + tile.height; ++y) {
    const size_t begin = out.at(tile.i0, y), end = begin + static_cast<size_t>(tile.width);
    for (size_t i = begin; i < end; ++i) out.pixels.r[i] += share[i] * static_cast<float>(r_[i]);
    for (size_t i = begin; i < end; ++i) out.pixels.g[i] += share[i] * static_cast<float>(g_[i]);
    for (size_t i = begin; i < end; ++i) out.pixels.b[i] += share[i] * static_cast<float>(b_[i]);
  }
}

size_t FilmLayer::blockOf(size_t pixel) const {
  const size_t x = pixel % static_cast<size_t>(width_), y = pixel / static_cast<size_t>(width_);
  return y / kErrorBlock * static_cast<size_t>(blockColumns_) + x / kErrorBlock;
}

}  // namespace ninefold
