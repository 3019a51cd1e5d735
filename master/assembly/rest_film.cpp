#include "master/assembly/rest_film.h"

#include <algorithm>

#include "master/assembly/picture.h"

namespace ninefold {

void RestFilm::begin(const TileGrid& grid, FilmKeeps keeps, bool isFirst) {
  const bool fits = film_ && film_->width() == grid.width() && film_->height() == grid.height() &&
                    film_->keeps() == keeps;
  if (!fits)
    film_.emplace(grid.width(), grid.height(), keeps);
  else if (isFirst)
    film_->clear();
  if (!fits || isFirst) has_.assign(static_cast<size_t>(grid.tiles()), 0);
}

bool RestFilm::addTile(int tile, const TaskRect& rect, const FilterDesk& desk) {
  if (has_[static_cast<size_t>(tile)]++ != 0) return false;
  ninefold::addTile(*film_, desk, rect);
  return true;
}

void RestFilm::frameDone() {
  film_->frameDone();
  film_->updateShare();
  std::ranges::fill(has_, 0);
}

}  // namespace ninefold
