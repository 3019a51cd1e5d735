// patch.h: one tile of a frame in planes, with a border of one sub-pixel around it in every phase:
// all that the filter needs to finish the tile's pixels, small enough to stay in the cache.
//
// Each phase (sampling/interleave.h) has a plane of kSide x kSide sub-pixels. Sub-pixel (i, j) of
// the phase's sub-plane is at (i - i0 + 1, j - j0 + 1); (i0, j0) is the tile's first one. Pixels
// outside the picture, or not filled in, have distance 0: no x, so the filter takes nothing from
// there.
//
// A layer is dark, and none of it counts, until something that is not black is placed in it. It
// glows if it has U anywhere.
//
// Threads: plain data.
// Memory:  taken by the first reset(); later ones of the same job take none.
// Errors:  place() throws Error if the result has not the shape and planes of its rectangle.
#pragma once

#include "common/image/layers.h"
#include "common/sampling/interleave.h"

namespace ninefold {

// Which planes of how many pixels a frame has.
struct FrameShape {
  TileGrid grid{0, 0, {}};
  uint8_t layerMask = kDiffuseBit;
  uint8_t extraMask = 0;
};

// Tiles come filtered by the clients: without layers, each in one task (phase 0).
inline bool isFiltered(const FrameShape& shape) { return isFinished(shape.layerMask); }

class Patch {
 public:
  static constexpr int kSide = kTaskSide + 2;
  static constexpr int kPixels = kSide * kSide;  // of a phase

  // Takes another tile; forgets all that was placed.
  void reset(const FrameShape& frame, int tile);

  // The part of a rectangle of the phase's sub-plane that lies in the patch, as far as the filter
  // looks across the tile's border in this phase.
  struct Overlap {
    int fromI = 0, fromJ = 0;  // in the rectangle
    int to = 0;                // index in the patch's planes
    int width = 0, height = 0;
  };
  Overlap overlap(int phase, const TaskRect& rect) const;

  // Copies the overlap with a rectangle's result; black layers, too, as the planes hold old values.
  void place(int phase, const TaskRect& rect, const TileResult& result);

  TileResult& phase(int p) { return phases_[static_cast<size_t>(p)]; }
  const TileResult& phase(int p) const { return phases_[static_cast<size_t>(p)]; }
  void lighten(uint8_t layers) { dark_ &= static_cast<uint8_t>(~layers); }
  bool isDark(int layer) const { return (dark_ >> layer & 1) != 0; }
  // Whether U of a layer counts; where not, its planes are not to be read.
  void setGlow(uint8_t layers) { glowing_ = layers; }
  bool glows(int layer) const { return (glowing_ >> layer & 1) != 0; }

  // The tile's own sub-pixels of a phase.
  const TaskRect& inner(int p) const { return inner_[static_cast<size_t>(p)]; }
  // The tile's pixels: the rectangle from (x0, y0).
  int x0() const { return x0_; }
  int y0() const { return y0_; }
  int width() const { return width_; }
  int height() const { return height_; }

  // Calls visit(index in the phase's planes, x, y in the image) for each of the tile's own pixels
  // of phase p.
  template <typename Visit>
  void forEachPixel(int p, const Visit& visit) const {
    const TaskRect& rect = inner(p);
    for (int j = 0; j < rect.height; ++j)
      for (int i = 0; i < rect.width; ++i)
        visit(static_cast<size_t>(j + 1) * kSide + static_cast<size_t>(i + 1),
              grid().pixelX(p, rect.i0 + i), grid().pixelY(p, rect.j0 + j));
  }

  const TileGrid& grid() const { return frame_.grid; }
  int phases() const { return grid().interleave().sets(); }
  uint8_t layerMask() const { return frame_.layerMask; }
  uint8_t extraMask() const { return frame_.extraMask; }

 private:
  FrameShape frame_;
  int i0_ = 0, j0_ = 0;
  int x0_ = 0, y0_ = 0, width_ = 0, height_ = 0;
  uint8_t dark_ = 0, glowing_ = 0;
  std::vector<TileResult> phases_;
  std::vector<TaskRect> inner_, reach_;  // by phase: without and with what is needed around it
};

// True if reflectance, E and U of a layer are 0 everywhere.
bool isBlack(const LayerPlanes& layer);

}  // namespace ninefold
