// film_layer.h: one colour of each pixel, summed up over frames. A film has one layer, or two: of
// unfiltered pixels, and of what the filter adds to them. Of luminance a layer also keeps the means
// by replication (replications.h), of pixels and of blocks.
//
// Per pixel and channel it keeps a running mean in double: no drift over millions of frames, and
// the mean of equal frames is exactly their value.
//
// Memory: 24 bytes a pixel, 56 with replications of pixels.
// Owner: Film.   Threads: addTile for different tiles at once, else one at a time.   Errors: CHECK.
// Proved: tests/image/film_test.cpp.
#pragma once

#include "common/image/image.h"
#include "common/image/replications.h"
#include "common/sampling/interleave.h"

namespace ninefold {

inline constexpr int kErrorBlock = 16;

class FilmLayer {
 public:
  FilmLayer(int width, int height, bool keepsPixels);

  void clear();
  // Part of frame number `frame`, from 0, whose top left pixel is (x0, y0).
  void addTile(int x0, int y0, const RgbImage& tile, int64_t frame);
  void frameDone(int64_t frame);

  // The mean of a tile's pixels into the same place of `out`, a picture of the film's size; or,
  // with `share`, that part of it added to what is there.
  void write(const TaskRect& tile, RgbImage& out) const;
  void add(const TaskRect& tile, const std::vector<float>& share, RgbImage& out) const;

  const Replications<float>& pixels() const { return pixels_; }   // luminance
  const Replications<double>& blocks() const { return blocks_; }  // row-major, then the whole
  const std::vector<double>& blockPixels() const { return blockPixels_; }  // n_b, likewise
  size_t blockOf(size_t pixel) const;

 private:
  void addLuminance(int x0, int y0, const RgbImage& tile, int64_t frame);

  int width_, height_, blockColumns_, blockRows_;
  std::vector<double> r_, g_, b_;  // means
  Replications<float> pixels_;     // empty if not kept
  Replications<double> blocks_;
  std::vector<double> blockMeans_;  // of the frame
  std::vector<double> blockPixels_;
};

}  // namespace ninefold
