// rest_film.h: the film of a live picture at rest. A frame may be given up half done and begun anew
// (live_plan.h). Both are the same estimate, so the tiles that the film has already stay, and none
// counts twice.
//
// Threads: addTile for different tiles at once, else one at a time.   Errors: none.
// Proved: tests/master/live_picture_test.cpp.
#pragma once

#include <optional>
#include <vector>

#include "common/image/film.h"
#include "common/image/patch_filter.h"

namespace ninefold {

class RestFilm {
 public:
  // A frame begins. isFirst: it is the first of a new picture.
  void begin(const TileGrid& grid, FilmKeeps keeps, bool isFirst);
  // False if the film has the tile already.
  bool addTile(int tile, const TaskRect& rect, const FilterDesk& desk);
  void frameDone();
  const Film& film() const { return *film_; }

 private:
  std::optional<Film> film_;
  std::vector<char> has_;  // by tile: of the frame that is not done yet
};

}  // namespace ninefold
