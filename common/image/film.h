// film.h: the mean over frames of one unchanging picture, and how far it may still be from its
// limit.
//
// Per pixel and channel: mean and M2 = sum (x - mean)^2 after Welford, in double: no drift over
// millions of frames, and frames that are all alike have exactly their own value as mean and
// exactly 0 as variance.
//
// Pixels of one frame share light sets, so that their errors are not independent and must not be
// averaged away. Hence the film also keeps the mean luminance per frame of the image and of each
// block of 16 x 16 pixels (less at the right and lower edge): N independent values each.
// With N frames and s^2 = M2/(N-1):
//
//   standardError()        s/sqrt(N) of each pixel and channel
//   relativeError()        sqrt(sum_b n_b s_b^2/N / sum_b n_b) / Y       b: blocks of n_b pixels
//   imageRelativeError()   (s_Y/sqrt(N)) / Y                             Y: mean image luminance
//
// relativeError() is what stop rules use. Both are infinite for N < 2, and 0 for a black image.
//
// A frame comes tile by tile, each pixel once; tiles begin at multiples of 16 pixels.
//
// Source:  Welford 1962.   Proved: tests/image/film_test.cpp.
// Threads: addTile for different tiles at once, else one at a time.
// The last bits depend on the order of frames: add them in the order of their index.
#pragma once

#include <cstdint>
#include <span>

#include "common/image/image.h"

namespace ninefold {

inline constexpr int kErrorBlock = 16;

// Running mean and sum of squared deviations of many quantities, all with the same number of
// values.
struct RunningMoments {
  std::vector<double> mean, m2;  // m2 may be left out
  void resize(size_t n, bool wantsM2) { mean.assign(n, 0), m2.assign(wantsM2 ? n : 0, 0); }
  // Takes `values` as the count-th values of quantities [first, first + size); count starts at 1.
  template <typename T>
  void add(std::span<const T> values, size_t first, int64_t count);
};

class Film {
 public:
  // keepsError: standardError() will be asked for, which takes M2 of every pixel.
  Film(int width, int height, bool keepsError = true);

  void clear();  // the picture has changed: start again
  // Part of the next frame, whose top left pixel is (x0, y0).
  void addTile(int x0, int y0, const RgbImage& tile);
  void frameDone();  // all its tiles were added
  void add(const RgbImage& frame);

  int width() const { return width_; }
  int height() const { return height_; }
  int64_t frames() const { return frames_; }
  void mean(RgbImage& out) const;           // black without frames
  void standardError(RgbImage& out) const;  // zero for N < 2
  double relativeError() const;
  double imageRelativeError() const;

 private:
  void addBlocks(int x0, int y0, const RgbImage& tile);
  double relative(double m2) const;  // sqrt(m2/(N-1)/N) / Y

  int width_, height_, blockColumns_, blockRows_;
  bool keepsError_;
  int64_t frames_ = 0;
  RunningMoments r_, g_, b_;
  RunningMoments blocks_;  // blocks row-major, then the whole image
  std::vector<double> blockMeans_;
  std::vector<double> blockPixels_;  // n_b, last the whole image
};

}  // namespace ninefold
