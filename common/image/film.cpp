#include "common/image/film.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/error.h"
#include "common/base/prefetch.h"

namespace ninefold {
namespace {

int ceilDivide(int a, int b) { return (a + b - 1) / b; }

// The count-th values of pixels whose running means are `mean`.
void addRow(const float* values, size_t n, int64_t count, double* mean) {
  const double share = 1.0 / static_cast<double>(count);
#pragma GCC ivdep
  for (size_t i = 0; i < n; ++i) mean[i] += (static_cast<double>(values[i]) - mean[i]) * share;
}

// Rows of a tile are far apart in the film, where no processor looks ahead by itself.
constexpr int kRowsAhead = 2;

}  // namespace

Film::Film(int width, int height, bool keepsError, bool twoRadii)
    : width_(width),
      height_(height),
      blockColumns_(ceilDivide(width, kErrorBlock)),
      blockRows_(ceilDivide(height, kErrorBlock)),
      keepsError_(keepsError),
      twoRadii_(twoRadii) {
  const size_t blocks = pixelCount(blockColumns_, blockRows_);
  blockMeans_.resize(blocks + 1);
  for (int by = 0; by < blockRows_; ++by)
    for (int bx = 0; bx < blockColumns_; ++bx)
      blockPixels_.push_back(std::min(kErrorBlock, width - bx * kErrorBlock) *
                             std::min(kErrorBlock, height - by * kErrorBlock));
  blockPixels_.push_back(static_cast<double>(width) * height);
  clear();
}

void Film::clear() {
  frames_ = 0;
  const size_t pixels = pixelCount(width_, height_);
  for (auto* mean : {&r_, &g_, &b_}) mean->assign(pixels, 0);
  if (keepsError_) pixels_.resize(pixels);
  blocks_.resize(blockMeans_.size());
  bias_ = {};
}

void Film::add(const RgbImage& frame) {
  addTile(0, 0, frame);
  frameDone();
}

void Film::addTile(int x0, int y0, const RgbImage& tile) {
  NINEFOLD_CHECK(x0 + tile.width <= width_);
  NINEFOLD_CHECK(y0 + tile.height <= height_);
  const int64_t count = frames_ + 1;
  const auto width = static_cast<size_t>(tile.width);
  for (int y = 0; y < tile.height; ++y) {
    const size_t to = pixelCount(width_, y0 + y) + static_cast<size_t>(x0);
    const size_t from = tile.at(0, y);
    if (y + kRowsAhead < tile.height)
      for (const auto* means : {&r_, &g_, &b_})
        prefetch<Soon::isWritten>(means->data() + to + pixelCount(width_, kRowsAhead),
                                  width * sizeof(double));
    addRow(&tile.pixels.r[from], width, count, &r_[to]);
    addRow(&tile.pixels.g[from], width, count, &g_[to]);
    addRow(&tile.pixels.b[from], width, count, &b_[to]);
  }
  addLuminance(x0, y0, tile);
}

// Adds to each pixel, and to the sums of the blocks, row by row within each block. A row's blocks
// take turns: an addition has to wait for the one before it to the same sum.
void Film::addLuminance(int x0, int y0, const RgbImage& tile) {
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
    if (keepsError_) pixels_.add(row, to, frames_);
  }
}

void Film::frameDone() {
  ++frames_;
  double whole = 0;
  for (size_t b = 0; b + 1 < blockMeans_.size(); ++b) {
    whole += blockMeans_[b];
    blockMeans_[b] /= blockPixels_[b];
  }
  blockMeans_.back() = whole / blockPixels_.back();
  blocks_.add(blockMeans_, 0, frames_ - 1);
  if (twoRadii_ && frames_ % kReplications == 0)
    bias_ =
        RadiusBias::of(blocks_, std::span(blockPixels_).first(blockPixels_.size() - 1), frames_);
}

void Film::mean(RgbImage& out) const {
  out.reset(width_, height_);
  meanOfTile({0, 0, width_, height_}, out);
}

void Film::meanOfTile(const TaskRect& tile, RgbImage& out) const {
  NINEFOLD_CHECK(out.width == width_);
  NINEFOLD_CHECK(out.height == height_);
  for (int y = tile.j0; y < tile.j0 + tile.height; ++y) {
    const size_t begin = out.at(tile.i0, y), end = begin + static_cast<size_t>(tile.width);
    for (size_t i = begin; i < end; ++i) out.pixels.r[i] = static_cast<float>(r_[i]);
    for (size_t i = begin; i < end; ++i) out.pixels.g[i] = static_cast<float>(g_[i]);
    for (size_t i = begin; i < end; ++i) out.pixels.b[i] = static_cast<float>(b_[i]);
  }
}

std::vector<float> Film::standardError() const {
  std::vector<float> error(pixelCount(width_, height_));
  for (size_t i = 0; i < error.size(); ++i) error[i] = standardError(i, frames_);
  return error;
}

float Film::standardError(size_t pixel, int64_t frames) const {
  NINEFOLD_CHECK(keepsError_);
  if (frames < 2) return 0;
  double squared = pixels_.estimate(pixel, frames).squaredError;
  if (!bias_.squares.empty()) {
    const size_t x = pixel % static_cast<size_t>(width_), y = pixel / static_cast<size_t>(width_);
    squared +=
        bias_.squares[y / kErrorBlock * static_cast<size_t>(blockColumns_) + x / kErrorBlock];
  }
  return static_cast<float>(std::sqrt(squared));
}

double Film::relativeError() const {
  if (frames_ < 2) return std::numeric_limits<double>::infinity();
  double sum = 0;
  for (size_t b = 0; b + 1 < blockPixels_.size(); ++b)
    sum += blockPixels_[b] * blocks_.estimate(b, frames_).squaredError;
  return relative(sum / blockPixels_.back() + bias_.squared);
}

double Film::imageRelativeError() const {
  if (frames_ < 2) return std::numeric_limits<double>::infinity();
  return relative(blocks_.estimate(blockPixels_.size() - 1, frames_).squaredError);
}

double Film::relative(double squaredError) const {
  if (squaredError == 0) return 0;
  return std::sqrt(squaredError) / blocks_.estimate(blockPixels_.size() - 1, frames_).mean;
}

}  // namespace ninefold
