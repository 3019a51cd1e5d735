#include "common/image/film.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/error.h"

namespace ninefold {
namespace {

constexpr int64_t kSharedEach = 8;  // frames after each of which a is worked out; then by eighths

void subtract(const RgbImage& a, const RgbImage& b, RgbImage& out) {
  out.reshape(a.width, a.height);
  for (const auto plane : {&RgbPlane::r, &RgbPlane::g, &RgbPlane::b}) {
    const float *x = (a.pixels.*plane).data(), *y = (b.pixels.*plane).data();
    float* d = (out.pixels.*plane).data();
#pragma GCC ivdep
    for (size_t i = 0; i < a.count(); ++i) d[i] = x[i] - y[i];
  }
}

}  // namespace

Film::Film(int width, int height, FilmKeeps keeps)
    : width_(width), height_(height), keeps_(keeps), unfiltered_(width, height, keeps.pixels()) {
  if (keeps.neighbours()) shift_.emplace(width, height, true);
  clear();
}

void Film::clear() {
  frames_ = 0, bias_ = {};
  unfiltered_.clear();
  if (!shift_) return;
  shift_->clear();
  share_.share.assign(pixelCount(width_, height_), 1);
  share_.squaredBias.assign(share_.share.size(), 0);
  sharedAt_ = 0;
}

void Film::add(const RgbImage& frame) {
  addTile(0, 0, frame);
  frameDone();
}

void Film::addTile(int x0, int y0, const RgbImage& tile, const RgbImage* filtered) {
  NINEFOLD_CHECK(keeps_.neighbours() == (filtered != nullptr));
  unfiltered_.addTile(x0, y0, tile, frames_);
  if (filtered == nullptr) return;
  RgbImage shift;
  subtract(*filtered, tile, shift);
  shift_->addTile(x0, y0, shift, frames_);
}

void Film::frameDone() {
  unfiltered_.frameDone(frames_);
  if (shift_) shift_->frameDone(frames_);
  ++frames_;
  const auto& n = unfiltered_.blockPixels();
  if (keeps_.twoRadii && frames_ % kReplications == 0)
    bias_ = RadiusBias::of(unfiltered_.blocks(), std::span(n).first(n.size() - 1), frames_);
}

void Film::updateShare() {
  if (!shift_ || frames_ < NeighbourShare::kFirst) return;
  if (frames_ > kSharedEach && frames_ - sharedAt_ < sharedAt_ / kSharedEach) return;
  share_ = shareNow();
  sharedAt_ = frames_;
}

NeighbourShare Film::shareNow() const {
  if (sharedAt_ == frames_) return share_;
  RgbImage filtered;
  filtered.reset(width_, height_);
  const TaskRect all{0, 0, width_, height_};
  unfiltered_.write(all, filtered);
  shift_->add(all, std::vector<float>(filtered.count(), 1), filtered);
  return NeighbourShare::of(filtered, shift_->pixels(), frames_, keeps_.pattern);
}

void Film::mean(RgbImage& out) const {
  out.reset(width_, height_);
  const TaskRect all{0, 0, width_, height_};
  unfiltered_.write(all, out);
  if (shift_) shift_->add(all, shareNow().share, out);
}

void Film::meanOfTile(const TaskRect& tile, RgbImage& out) const {
  NINEFOLD_CHECK(out.width == width_);
  NINEFOLD_CHECK(out.height == height_);
  unfiltered_.write(tile, out);
  if (shift_) shift_->add(tile, share_.share, out);
}

std::vector<float> Film::standardError() const {
  const NeighbourShare share = shift_ ? shareNow() : NeighbourShare{};
  std::vector<float> error(pixelCount(width_, height_));
  for (size_t i = 0; i < error.size(); ++i) error[i] = standardError(i, frames_, share);
  return error;
}

float Film::standardError(size_t pixel, int64_t frames) const {
  return standardError(pixel, frames, share_);
}

float Film::standardError(size_t pixel, int64_t frames, const NeighbourShare& share) const {
  NINEFOLD_CHECK(keeps_.pixels());
  if (frames < 2) return 0;
  double squared = 0;
  if (shift_) {
    const auto a = static_cast<double>(share.share[pixel]);
    squared = estimateSum(unfiltered_.pixels(), a, shift_->pixels(), pixel, frames).squaredError +
              static_cast<double>(share.squaredBias[pixel]);
  } else {
    squared = unfiltered_.pixels().estimate(pixel, frames).squaredError;
  }
  if (!bias_.squares.empty()) squared += bias_.squares[unfiltered_.blockOf(pixel)];
  return static_cast<float>(std::sqrt(squared));
}

double Film::relativeError() const {
  if (frames_ < 2) return std::numeric_limits<double>::infinity();
  const auto& n = unfiltered_.blockPixels();
  double sum = 0;
  for (size_t b = 0; b + 1 < n.size(); ++b)
    sum += n[b] * unfiltered_.blocks().estimate(b, frames_).squaredError;
  return relative(sum / n.back() + bias_.squared);
}

double Film::imageRelativeError() const {
  if (frames_ < 2) return std::numeric_limits<double>::infinity();
  const size_t whole = unfiltered_.blockPixels().size() - 1;
  return relative(unfiltered_.blocks().estimate(whole, frames_).squaredError);
}

double Film::relative(double squaredError) const {
  if (squaredError == 0) return 0;
  const size_t whole = unfiltered_.blockPixels().size() - 1;
  return std::sqrt(squaredError) / unfiltered_.blocks().estimate(whole, frames_).mean;
}

}  // namespace ninefold
