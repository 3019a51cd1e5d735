// frame_buffer.h: the planes of one frame, gathered from its tasks. The pixels of each phase stay
// together in a sub-plane (sampling/interleave.h), so that placing a task copies whole rows and the
// filter reads its neighbours from contiguous rows of the other sub-planes.
//
// No allocation after reset(), nor in a reset() to a shape that fitted before. A next frame of the
// same shape needs no reset: its tasks overwrite every pixel.
//
// Threads: place() may run at once for different (tile, phase); readers wait until it returned.
// Errors:  place() throws Error if the result has not the shape or the planes of its task.
#pragma once

#include "common/image/layers.h"
#include "common/sampling/interleave.h"

namespace ninefold {

class FrameBuffer {
 public:
  FrameBuffer(const TileGrid& grid, uint8_t layerMask, uint8_t extraMask);

  // Takes a new shape and zeroes all planes.
  void reset(const TileGrid& grid, uint8_t layerMask, uint8_t extraMask);
  void place(int tile, int phase, const TileResult& result);

  const TileGrid& grid() const { return grid_; }
  uint8_t layerMask() const { return layerMask_; }
  uint8_t extraMask() const { return extraMask_; }
  // All pixels of a phase, grid().subWidth(phase) * grid().subHeight(phase), row-major. `rays` is
  // unused.
  const TileResult& phase(int p) const { return phases_[static_cast<size_t>(p)]; }

 private:
  TileGrid grid_;
  uint8_t layerMask_, extraMask_;
  std::vector<TileResult> phases_;
};

}  // namespace ninefold
