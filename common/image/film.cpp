#include "common/image/film.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/error.h"

namespace ninefold {
namespace {

constexpr int64_t kSharedEach = 8;  // frames after each of which a is worked out; then by eighths

// Rows of a tile are far apart in the film, where no processor looks ahead by itself.
constexpr int kRowsAhead = 2;

FilmRow rowOf(const RgbImage& tile, int y) {
  const size_t i = tile.at(0, y);
  return {&tile.pixels.r[i], &tile.pixels.g[i], &tile.pixels.b[i], {}};
}

// A row that is worked out: luminance, or a difference and its luminance.
class RowBuffer {
 public:
  explicit RowBuffer(int width)
      : width_(static_cast<size_t>(width)),
        values_(4 * width_),
        luminance_(values_.data() + 3 * width_) {}

  FilmRow withLuminance(FilmRow row) {
#pragma GCC ivdep
    for (size_t i = 0; i < width_; ++i)
      luminance_[i] = luminance(Vec3(row.r[i], row.g[i], row.b[i]));
    row.luminance = {luminance_, width_};
    return row;
  }
  FilmRow difference(const FilmRow& a, const FilmRow& b) {
    float *dr = values_.data(), *dg = dr + width_, *db = dg + width_;
#pragma GCC ivdep
    for (size_t i = 0; i < width_; ++i)
      dr[i] = a.r[i] - b.r[i], dg[i] = a.g[i] - b.g[i], db[i] = a.b[i] - b.b[i];
    return withLuminance({dr, dg, db, {}});
  }

 private:
  size_t width_;
  std::vector<float> values_;
  float* luminance_;
};

}  // namespace

Film::Film(int width, int height, FilmKeeps keeps)
    : width_(width),
      height_(height),
      keeps_(keeps),
      unfiltered_(width, height, keeps.pixels()),
      blocks_(width, height) {
  if (keeps.neighbours()) shift_.emplace(width, height, true);
  clear();
}

void Film::clear() {
  frames_ = 0, bias_ = {};
  unfiltered_.clear();
  blocks_.clear();
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
  NINEFOLD_CHECK(x0 + tile.width <= width_);
  NINEFOLD_CHECK(y0 + tile.height <= height_);
  NINEFOLD_CHECK(y0 % kErrorBlock == 0);
  RowBuffer buffer(tile.width);
  for (int y = 0; y < tile.height; ++y) {
    const size_t first = pixelCount(width_, y0 + y) + static_cast<size_t>(x0);
    if (y + kRowsAhead < tile.height) prefetch(first + pixelCount(width_, kRowsAhead), tile.width);
    const FilmRow row = rowOf(tile, y), bright = buffer.withLuminance(row);
    unfiltered_.add(first, bright, frames_);
    blocks_.add(x0, y0 + y, bright.luminance);
    if (shift_) shift_->add(first, buffer.difference(rowOf(*filtered, y), row), frames_);
  }
}

void Film::prefetch(size_t first, int count) const {
  unfiltered_.prefetch(first, static_cast<size_t>(count));
  if (shift_) shift_->prefetch(first, static_cast<size_t>(count));
}

void Film::frameDone() {
  blocks_.frameDone(frames_);
  ++frames_;
  if (keeps_.twoRadii && frames_ % kReplications == 0)
    bias_ = RadiusBias::of(blocks_.means(), blocks_.pixels().first(blocks_.count()), frames_);
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
  shift_->addTo(all, std::vector<float>(filtered.count(), 1), filtered);
  return NeighbourShare::of(filtered, shift_->luminance(), frames_, keeps_.pattern);
}

void Film::mean(RgbImage& out) const {
  out.reset(width_, height_);
  const TaskRect all{0, 0, width_, height_};
  unfiltered_.write(all, out);
  if (shift_) shift_->addTo(all, shareNow().share, out);
}

void Film::meanOfTile(const TaskRect& tile, RgbImage& out) const {
  NINEFOLD_CHECK(out.width == width_);
  NINEFOLD_CHECK(out.height == height_);
  unfiltered_.write(tile, out);
  if (shift_) shift_->addTo(tile, share_.share, out);
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
    squared =
        estimateSum(unfiltered_.luminance(), a, shift_->luminance(), pixel, frames).squaredError +
        static_cast<double>(share.squaredBias[pixel]);
  } else {
    squared = unfiltered_.luminance().estimate(pixel, frames).squaredError;
  }
  if (!bias_.squares.empty()) squared += bias_.squares[blocks_.blockOf(pixel)];
  return static_cast<float>(std::sqrt(squared));
}

double Film::relativeError() const {
  if (frames_ < 2) return std::numeric_limits<double>::infinity();
  double sum = 0;
  for (size_t b = 0; b < blocks_.count(); ++b)
    sum += blocks_.pixels()[b] * blocks_.means().estimate(b, frames_).squaredError;
  return relative(sum / blocks_.pixels().back() + bias_.squared);
}

double Film::imageRelativeError() const {
  if (frames_ < 2) return std::numeric_limits<double>::infinity();
  return relative(blocks_.whole(frames_).squaredError);
}

double Film::relative(double squaredError) const {
  if (squaredError == 0) return 0;
  return std::sqrt(squaredError) / blocks_.whole(frames_).mean;
}

}  // namespace ninefold
