// film.h: the mean over frames of one unchanging picture, and how far it may still be from its
// limit.
//
// Where the discontinuity buffer filters, frames come twice, unfiltered and filtered. The mean is
// then L = U + a D (neighbour_share.h), else L = U.
//
// Pixels of one frame share light sets, so their errors are not independent and must not be
// averaged away. Hence the film also keeps the mean luminance of the image and of blocks of 16 x 16
// pixels (less at the right and lower edge). Eight replications give each mean its standard error e
// (replications.h):
//
//   standardError()        sqrt(e^2 + a^2 b^2 + B_b^2) of each pixel
//   relativeError()        sqrt(sum_b n_b (e_b^2 + B_b^2) / sum_b n_b) / Y      what stop rules use
//   imageRelativeError()   e_Y / Y
//
//   b, n_b   a block, and how many pixels it has
//   B_b      bias by the photons' radius after the last full turn of replications, where frames
//            take two radii by turns (radius_bias.h)
//   a^2 b^2  squared bias by the discontinuity buffer
//   Y, e_Y   mean luminance of the image, and its standard error
//
// Both relative errors are infinite for fewer than two frames, and 0 for a black image. Blocks and
// the image have the errors of U: the filter moves light between pixels that are side by side.
//
// A frame comes tile by tile, each pixel once; tiles begin at multiples of 16 pixels. The last bits
// depend on the order of frames: add them in the order of their index. mean() and standardError()
// of all pixels have a of all frames; to find it costs as much as a frame. What is asked of parts
// has a of the last updateShare().
//
// Memory:  24 bytes a pixel, 56 with errors, 108 with neighbours, and 40 while a is found.
// Proved:  tests/image/film_test.cpp, tests/image/neighbour_share_test.cpp.
// Threads: addTile and meanOfTile for different tiles at once, else one at a time.
#pragma once

#include <cstdint>
#include <optional>

#include "common/base/error.h"
#include "common/image/film_blocks.h"
#include "common/image/film_layer.h"
#include "common/image/neighbour_share.h"
#include "common/image/radius_bias.h"

namespace ninefold {

struct FilmKeeps {
  bool error = true;      // standardError() will be asked for
  bool twoRadii = false;  // even frames have photons of a wider radius than odd ones
  // n x m of the discontinuity buffer, if frames come filtered, too. 1x1: they do not.
  Interleave pattern{1, 1};
  bool neighbours() const { return pattern.sets() > 1; }
  bool pixels() const { return error || neighbours(); }  // means of every pixel by replication
  bool operator==(const FilmKeeps&) const = default;
};

class Film {
 public:
  Film(int width, int height, FilmKeeps keeps = {});

  void clear();  // the picture has changed: start again
  // Part of the next frame, whose top left pixel is (x0, y0). filtered: the same part, if the film
  // keeps neighbours.
  void addTile(int x0, int y0, const RgbImage& tile, const RgbImage* filtered = nullptr);
  void frameDone();  // all its tiles were added
  // a for parts: after each of the first eight frames, then as the film grows by an eighth. Else it
  // does nothing.
  void updateShare();
  void add(const RgbImage& frame);

  int width() const { return width_; }
  int height() const { return height_; }
  FilmKeeps keeps() const { return keeps_; }
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

  // That visitKept may come to, beyond what it comes to now.
  size_t mostBiasBytes() const { return blocks_.count() * sizeof(double); }
  // All that the next frames and the errors need, as visit(span) of numbers, to keep it or to put
  // back what was kept: then the film must be new, and have the same size and keeps. A visit that
  // puts back may throw Error; so does this, if what it put does not fit together.
  template <typename Self, typename Visit>
  static void visitKept(Self& self, Visit& visit) {
    visit(std::span(&self.frames_, 1));
    FilmLayer<double>::visitKept(self.unfiltered_, visit);
    FilmBlocks::visitKept(self.blocks_, visit);
    RadiusBias::visitKept(self.bias_, self.blocks_.count(), visit);
    if (!self.shift_) return;
    FilmLayer<float>::visitKept(*self.shift_, visit);
    visit(std::span(self.share_.share)), visit(std::span(self.share_.squaredBias));
    visit(std::span(&self.sharedAt_, 1));
    if (self.sharedAt_ < 0 || self.sharedAt_ > self.frames_)
      fail("the film's share of neighbours is of {} frames, it has {}", self.sharedAt_,
           self.frames_);
  }

 private:
  void prefetch(size_t first, int count) const;
  NeighbourShare shareNow() const;  // a of all frames that are done
  float standardError(size_t pixel, int64_t frames, const NeighbourShare& share) const;
  double relative(double squaredError) const;  // its root over Y

  int width_, height_;
  FilmKeeps keeps_;
  int64_t frames_ = 0;                     // that are done
  FilmLayer<double> unfiltered_;           // U
  std::optional<FilmLayer<float>> shift_;  // D
  FilmBlocks blocks_;                      // of U
  NeighbourShare share_;
  int64_t sharedAt_ = 0;  // frames that share_ was worked out of
  RadiusBias bias_;
};

}  // namespace ninefold
