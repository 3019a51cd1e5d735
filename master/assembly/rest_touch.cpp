#include "master/assembly/rest_touch.h"

namespace ninefold {

void RestTouch::begin(const TileGrid& grid, bool isFirst) {
  const bool fits = guides_ && width_ == grid.width() && height_ == grid.height();
  if (fits && !isFirst) return;
  width_ = grid.width(), height_ = grid.height(), frames_ = 0;
  if (fits)
    guides_->clear();
  else
    guides_.emplace(width_, height_);
}

void RestTouch::show(const Film& film, const RgbImage& mean, const ToneMap& toneMap, bool isLast,
                     int threads, const std::stop_token& stop, DisplayImage& codes) {
  const int64_t frames = film.frames();
  if (frames < 2 || guides_->frames() != frames) return;
  if (isLast || 4 * frames >= 5 * frames_ + 16) {
    touched_ = mean;
    frames_ = 0;
    if (!denoise(touched_, film.standardError(), guides_->guides(), threads, stop)) return;
    frames_ = frames;
  }
  if (frames_ > 0) toneMap.apply(touched_, codes);
}

}  // namespace ninefold
