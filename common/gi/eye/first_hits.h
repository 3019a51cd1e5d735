// first_hits.h: what the eye sees, the same for every method: the first hits, shaded, and their
// extra planes. A packet is sixteen eye rays of 4x4 neighbours of the sub-plane.
//
// Film positions are jittered per pixel by the frame's randomization (anti-aliasing), or at the
// centre. Where a pixel has several paths, its extra planes are those of the first.
//
// Threads: reentrant with one TaskContext a thread.   Errors: none.
#pragma once

#include "common/gi/eye/task_context.h"

namespace ninefold {

// What one eye ray met.
struct FirstHit {
  size_t pixel = 0;    // in the task's rectangle, row-major
  int x = 0, y = 0;    // in the image
  Vec3 direction{0};   // unit, of the ray
  float distance = 0;  // [m]; 0 = nothing was met
  ShadingPoint point;  // valid if something was
  explicit operator bool() const { return distance > 0; }
};

inline constexpr int kBlockSide = 4;  // a packet is a block of 4 x 4 pixels

// The eye rays of path number `path` of a block's pixels. (bi, bj): the block's upper left corner.
struct EyeBlock {
  int bi = 0, bj = 0;
  uint32_t active = 0;
  RayPacket rays;
  Hit hits[kPacket];
};
EyeBlock traceBlock(TaskContext& context, uint32_t path, int bi, int bj);

// Shades what one lane met, and fills the pixel's extra planes if `path` is the first.
FirstHit firstHitOf(TaskContext& context, uint32_t path, const EyeBlock& block, int lane);

// Calls visit(const FirstHit&) for every pixel of the task.
template <typename Visit>
void forEachFirstHit(TaskContext& c, uint32_t path, const Visit& visit) {
  for (int bj = 0; bj < c.rect.height; bj += kBlockSide)
    for (int bi = 0; bi < c.rect.width; bi += kBlockSide) {
      const EyeBlock block = traceBlock(c, path, bi, bj);
      for (int lane = 0; lane < kPacket; ++lane)
        if ((block.active >> lane & 1u) != 0) visit(firstHitOf(c, path, block, lane));
    }
}

}  // namespace ninefold
