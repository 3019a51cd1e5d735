// film_layer.h: one colour of each pixel, summed up over frames. A film has one layer, or two: of
// unfiltered pixels, and of what the filter adds to them. Of luminance a layer also keeps the means
// by replication (replications.h).
//
// Per pixel and channel it keeps a running mean m += (x - m)/N, so that the mean of equal frames is
// exactly their value:
//
//   T = double   no drift over millions of frames
//   T = float    errs by about 2^-25 sqrt(N/3) |m|; for what is small beside another layer
//
// Memory: three T a pixel, and 32 bytes with replications.
// Owner: Film.   Threads: add for disjoint pixels at once, else one at a time.   Errors: none.
// Proved: tests/image/film_test.cpp.
#pragma once

#include <span>

#include "common/image/image.h"
#include "common/image/replications.h"
#include "common/sampling/interleave.h"

namespace ninefold {

// Pixels side by side in a frame.
struct FilmRow {
  const float *r = nullptr, *g = nullptr, *b = nullptr;
  std::span<const float> luminance;  // one a pixel
};

template <typename T>
class FilmLayer {
 public:
  FilmLayer(int width, int height, bool keepsLuminance);

  void clear();
  // Pixels first, first + 1, ... (row-major) of frame number `frame`, from 0.
  void add(size_t first, const FilmRow& row, int64_t frame);
  // Asks the memory for pixels that will soon be added to.
  void prefetch(size_t first, size_t count) const;

  // The mean of a tile's pixels into the same place of `out`, a picture of the film's size; or,
  // with `share`, that part of it added to what is there.
  void write(const TaskRect& tile, RgbImage& out) const;
  void addTo(const TaskRect& tile, const std::vector<float>& share, RgbImage& out) const;

  const Replications<float>& luminance() const { return luminance_; }

  // All that add has left, as visit(span).
  template <typename Self, typename Visit>
  static void visitKept(Self& self, Visit& visit) {
    for (auto* mean : {&self.r_, &self.g_, &self.b_}) visit(std::span(*mean));
    Replications<float>::visitKept(self.luminance_, visit);
  }

 private:
  size_t pixels_;
  std::vector<T> r_, g_, b_;       // means
  Replications<float> luminance_;  // empty if not kept
};

extern template class FilmLayer<float>;
extern template class FilmLayer<double>;

}  // namespace ninefold
