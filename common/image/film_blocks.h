// film_blocks.h: mean luminance of blocks of 16 x 16 pixels (less at the right and lower edge) and
// of the whole image, by replication (replications.h).
//
// Owner: Film.   Threads: add for pixels of different blocks at once, else one at a time.
// Errors: CHECK.   Proved: tests/image/film_test.cpp.
#pragma once

#include "common/image/replications.h"

namespace ninefold {

inline constexpr int kErrorBlock = 16;

class FilmBlocks {
 public:
  FilmBlocks(int width, int height);

  void clear();
  // Luminance of pixels side by side from (x, y) on; x a multiple of kErrorBlock, rows of a block from
  // its first downwards.
  void add(int x, int y, std::span<const float> luminance);
  void frameDone(int64_t frame);  // all pixels of frame number `frame` were added

  size_t count() const { return means_.size() - 1; }
  const Replications<double>& means() const { return replications_; }  // row-major, then the whole
  std::span<const double> pixels() const { return pixels_; }           // n_b, likewise
  Estimate whole(int64_t frames) const { return replications_.estimate(count(), frames); }
  size_t blockOf(size_t pixel) const;

  // All that frameDone has left, as visit(span).
  template <typename Self, typename Visit>
  static void visitKept(Self& self, Visit& visit) {
    Replications<double>::visitKept(self.replications_, visit);
  }

 private:
  int width_, columns_, rows_;
  Replications<double> replications_;
  std::vector<double> means_;  // of the frame
  std::vector<double> pixels_;
};

}  // namespace ninefold
