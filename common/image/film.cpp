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
void RunningMoments::add(const std::vector<T>& values, int64_t count) {
  NINEFOLD_CHECK(values.size() == mean.size());
  const double share = 1.0 / static_cast<double>(count);
  const T* x = values.data();
  double* m = mean.data();
  double* s = m2.data();
  const size_t n = values.size();
#pragma GCC ivdep
  for (size_t i = 0; i < n; ++i) {
    const double before = static_cast<double>(x[i]) - m[i];
    m[i] += before * share;
    s[i] += before * (static_cast<double>(x[i]) - m[i]);
  }
}

Film::Film(int width, int height)
    : width_(width),
      height_(height),
      blockColumns_(ceilDivide(width, kErrorBlock)),
      blockRows_(ceilDivide(height, kErrorBlock)) {
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
  for (RunningMoments* m : {&r_, &g_, &b_}) m->resize(pixels);
  blocks_.resize(blockMeans_.size());
}

void Film::add(const RgbImage& frame) {
  NINEFOLD_CHECK(frame.width == width_ && frame.height == height_);
  ++frames_;
  r_.add(frame.pixels.r, frames_);
  g_.add(frame.pixels.g, frames_);
  b_.add(frame.pixels.b, frames_);
  addBlocks(frame);
}

void Film::addBlocks(const RgbImage& frame) {
  std::fill(blockMeans_.begin(), blockMeans_.end(), 0.0);
  for (int y = 0; y < height_; ++y) {
    double* row = &blockMeans_[pixelCount(blockColumns_, y / kErrorBlock)];
    for (int x = 0; x < width_; ++x)
      row[x / kErrorBlock] += static_cast<double>(luminance(frame.rgb(frame.at(x, y))));
  }
  double whole = 0;
  for (size_t b = 0; b + 1 < blockMeans_.size(); ++b) {
    whole += blockMeans_[b];
    blockMeans_[b] /= blockPixels_[b];
  }
  blockMeans_.back() = whole / blockPixels_.back();
  blocks_.add(blockMeans_, frames_);
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
