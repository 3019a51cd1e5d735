#include "common/image/film.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/error.h"

namespace ninefold {
namespace {

int ceilDivide(int a, int b) { return (a + b - 1) / b; }

float standardErrorOf(double m2, int64_t n) {
  return static_cast<float>(std::sqrt(m2 / static_cast<double>(n - 1) / static_cast<double>(n)));
}

}  // namespace

template <typename T>
void RunningMoments::add(std::span<const T> values, size_t first, int64_t count) {
  NINEFOLD_CHECK(first + values.size() <= mean.size());
  const double share = 1.0 / static_cast<double>(count);
  const T* x = values.data();
  double* m = mean.data() + first;
  const size_t n = values.size();
  if (m2.empty()) {
#pragma GCC ivdep
    for (size_t i = 0; i < n; ++i) m[i] += (static_cast<double>(x[i]) - m[i]) * share;
    return;
  }
  double* s = m2.data() + first;
#pragma GCC ivdep
  for (size_t i = 0; i < n; ++i) {
    const double before = static_cast<double>(x[i]) - m[i];
    m[i] += before * share;
    s[i] += before * (static_cast<double>(x[i]) - m[i]);
  }
}

Film::Film(int width, int height, bool keepsError)
    : width_(width),
      height_(height),
      blockColumns_(ceilDivide(width, kErrorBlock)),
      blockRows_(ceilDivide(height, kErrorBlock)),
      keepsError_(keepsError) {
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
  for (RunningMoments* m : {&r_, &g_, &b_}) m->resize(pixels, keepsError_);
  blocks_.resize(blockMeans_.size(), true);
}

void Film::add(const RgbImage& frame) {
  addTile(0, 0, frame);
  frameDone();
}

void Film::addTile(int x0, int y0, const RgbImage& tile) {
  NINEFOLD_CHECK(x0 + tile.width <= width_ && y0 + tile.height <= height_);
  const int64_t count = frames_ + 1;
  const auto width = static_cast<size_t>(tile.width);
  for (int y = 0; y < tile.height; ++y) {
    const size_t to = pixelCount(width_, y0 + y) + static_cast<size_t>(x0);
    const size_t from = tile.at(0, y);
    r_.add(std::span<const float>(tile.pixels.r).subspan(from, width), to, count);
    g_.add(std::span<const float>(tile.pixels.g).subspan(from, width), to, count);
    b_.add(std::span<const float>(tile.pixels.b).subspan(from, width), to, count);
  }
  addBlocks(x0, y0, tile);
}

// Sums of the luminance, row by row within each block.
void Film::addBlocks(int x0, int y0, const RgbImage& tile) {
  NINEFOLD_CHECK(x0 % kErrorBlock == 0 && y0 % kErrorBlock == 0);
  for (int y = 0; y < tile.height; ++y) {
    double* row = &blockMeans_[pixelCount(blockColumns_, (y0 + y) / kErrorBlock) +
                               static_cast<size_t>(x0 / kErrorBlock)];
    if (y % kErrorBlock == 0) std::fill_n(row, ceilDivide(tile.width, kErrorBlock), 0.0);
    for (int x = 0; x < tile.width; ++x)
      row[x / kErrorBlock] += static_cast<double>(luminance(tile.rgb(tile.at(x, y))));
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
  blocks_.add(std::span<const double>(blockMeans_), 0, frames_);
}

void Film::mean(RgbImage& out) const {
  out.reset(width_, height_);
  for (size_t i = 0; i < out.count(); ++i) {
    out.pixels.r[i] = static_cast<float>(r_.mean[i]);
    out.pixels.g[i] = static_cast<float>(g_.mean[i]);
    out.pixels.b[i] = static_cast<float>(b_.mean[i]);
  }
}

void Film::standardError(RgbImage& out) const {
  NINEFOLD_CHECK(keepsError_);
  out.reset(width_, height_);
  if (frames_ < 2) return;
  for (size_t i = 0; i < out.count(); ++i) {
    out.pixels.r[i] = standardErrorOf(r_.m2[i], frames_);
    out.pixels.g[i] = standardErrorOf(g_.m2[i], frames_);
    out.pixels.b[i] = standardErrorOf(b_.m2[i], frames_);
  }
}

double Film::relativeError() const {
  double sum = 0;
  for (size_t b = 0; b + 1 < blockPixels_.size(); ++b) sum += blockPixels_[b] * blocks_.m2[b];
  return relative(sum / blockPixels_.back());
}

double Film::imageRelativeError() const { return relative(blocks_.m2.back()); }

double Film::relative(double m2) const {
  if (frames_ < 2) return std::numeric_limits<double>::infinity();
  const double error =
      std::sqrt(m2 / static_cast<double>(frames_ - 1) / static_cast<double>(frames_));
  return error == 0 ? 0 : error / blocks_.mean.back();
}

}  // namespace ninefold
