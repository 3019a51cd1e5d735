// assembly_books.h: which results of which frames are there, and which tile can be finished next. A
// pure value: no pixels, threads or clock.
//
//   open -> place (each task once) -> nextTile ... tileDone -> ... -> isDone -> close
//
// A tile can be finished when all results of it and of the tiles around it are there, for the
// filter looks across its border; a tile that comes filtered needs no other. Only tiles of the
// *front* frame, the open one of the smallest number, are handed out: the film gets frames in their
// order and can be looked at between two of them. Later frames gather their results meanwhile. A
// result is dropped once its tile and those around it are done.
//
// Threads: none; one owner.   Errors: only broken assumptions of the caller (CHECK).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "common/sampling/interleave.h"

namespace ninefold {

class AssemblyBooks {
 public:
  int openFrames() const { return static_cast<int>(frames_.size()); }
  void open(uint32_t frame, const TileGrid& grid, bool filtered);
  bool isOpen(uint32_t frame) const { return frames_.contains(frame); }

  // Is this result still to come?
  bool isWanted(uint32_t frame, int tile, int phase) const;
  // It is there. Needs isWanted.
  void place(uint32_t frame, int tile, int phase);

  // The number of the frame that is being finished; nothing if none is open.
  std::optional<uint32_t> front() const;
  // The front frame's next tile to be finished, each once.
  std::optional<int> nextTile();
  bool hasTile() const;
  // A tile is done. Gives back the tiles whose results nobody needs any more.
  std::vector<int> tileDone(uint32_t frame, int tile);
  bool isDone(uint32_t frame) const;  // all tiles are
  void close(uint32_t frame);

 private:
  struct Frame {
    TileGrid grid;
    int reach;                 // tiles around a tile that it needs: 1, or 0 if tiles come filtered
    std::vector<bool> there;   // by task
    std::vector<int> missing;  // by tile: results of it and of those around it that are to come
    std::vector<int> users;    // by tile: it and those around it, as far as they are not done
    std::vector<int> ready;    // tiles, last one first
    int left = 0;              // tiles that are not done
  };
  static size_t taskIndex(const Frame& frame, int tile, int phase);

  std::map<uint32_t, Frame> frames_;
};

// Calls f(tile) for a tile and those that lie up to `reach` tiles beside it.
template <typename F>
void forEachAround(const TileGrid& grid, int tile, int reach, const F& f) {
  const int column = tile % grid.columns(), row = tile / grid.columns();
  for (int r = std::max(0, row - reach); r <= std::min(row + reach, grid.rows() - 1); ++r)
    for (int c = std::max(0, column - reach); c <= std::min(column + reach, grid.columns() - 1);
         ++c)
      f(r * grid.columns() + c);
}

}  // namespace ninefold
