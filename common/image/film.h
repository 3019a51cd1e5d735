// film.h: the mean over frames of one unchanging picture, and how far it may still be from its
// limit.
//
// Per pixel and channel it keeps a running mean in double: no drift over millions of frames, and
// the mean of equal frames is exactly their value.
//
// Pixels of one frame share light sets, so their errors are not independent and must not be
// averaged away. Hence the film also keeps the mean luminance of the image and of blocks of 16 x 16
// pixels (less at the right and lower edge). Eight replications give each mean its standard error e
// (replications.h):
//
//   standardError()        e of each pixel
//   relativeError()        sqrt(sum_b n_b (e_b^2 + B_b^2) / sum_b n_b) / Y      what stop rules use
//   imageRelativeError()   e_Y / Y
//
//   b, n_b   a block, and how many pixels it has
//   B_b      bias by the photons' radius after the last full turn of replications, where frames
//            take two radii by turns (radius_bias.h); standardError() includes it, too
//   Y, e_Y   mean luminance of the image, and its standard error
//
// Both relative errors are infinite for fewer than two frames, and 0 for a black image.
// A frame comes tile by tile, each pixel once; tiles begin at multiples of 16 pixels. The last bits
// depend on the order of frames: add them in the order of their index.
//
// Proved:  tests/image/film_test.cpp.
// Threads: addTile for different tiles at once, else one at a time.
#pragma once

#include <cstdint>

#include "common/image/image.h"
#include "common/image/radius_bias.h"
#include "common/image/replications.h"
#include "common/sampling/interleave.h"

namespace ninefold {

inline constexpr int kErrorBlock = 16;

class Film {
 public:
  // keepsError: standardError() will be asked for; it takes eight means of every pixel.
  // twoRadii: even frames have photons of a wider radius than odd ones.
  Film(int width, int height, bool keepsError = true, bool twoRadii = false);

  void clear();  // the picture has changed: start again
  // Part of the next frame, whose top left pixel is (x0, y0).
  void addTile(int x0, int y0, const RgbImage& tile);
  void frameDone();  // all its tiles were added
  void add(const RgbImage& frame);

  int width() const { return width_; }
  int height() const { return height_; }
  bool twoRadii() const { return twoRadii_; }
  int64_t frames() const { return frames_; }
  void mean(RgbImage& out) const;  // black without frames
  // The mean of a tile's pixels, up to the frame last added to it, into the same place of `out`, a
  // picture of the film's size.
  void meanOfTile(const TaskRect& tile, RgbImage& out) const;
  std::vector<float> standardError() const;  // row-major; zero for N < 2
  // Of one pixel after `frames` frames: frames(), or one more if the next one was added to it.
  float standardError(size_t pixel, int64_t frames) const;
  double relativeError() const;
  double imageRelativeError() const;

 private:
  void addLuminance(int x0, int y0, const RgbImage& tile);
  double relative(double squaredError) const;  // its root over Y

  int width_, height_, blockColumns_, blockRows_;
  bool keepsError_, twoRadii_;
  int64_t frames_ = 0;
  std::vector<double> r_, g_, b_;  // means
  Replications<float> pixels_;     // empty without keepsError
  Replications<double> blocks_;    // blocks row-major, then the whole image
  std::vector<double> blockMeans_;
  std::vector<double> blockPixels_;  // n_b, last the whole image
  RadiusBias bias_;
};

}  // namespace ninefold
