#include "master/assembly/rest_film.h"

#include <algorithm>

namespace ninefold {

void RestFilm::begin(const TileGrid& grid, bool keepsError, bool twoRadii, bool isFirst) {
  const bool fits = film_ && film_->width() == grid.width() && film_->height() == grid.height() &&
                    keepsError_ == keepsError && film_->twoRadii() == twoRadii;
  if (!fits)
    film_.emplace(grid.width(), grid.height(), keepsError_ = keepsError, twoRadii);
  else if (isFirst)
    film_->clear();
  if (!fits || isFirst) has_.assign(static_cast<size_t>(grid.tiles()), 0);
}

bool RestFilm::addTile(int tile, const TaskRect& rect, const RgbImage& beauty) {
  if (has_[static_cast<size_t>(tile)]++ != 0) return false;
  film_->addTile(rect.i0, rect.j0, beauty);
  return true;
}

void RestFilm::frameDone() {
  film_->frameDone();
  std::ranges::fill(has_, 0);
}

}  // namespace ninefold
