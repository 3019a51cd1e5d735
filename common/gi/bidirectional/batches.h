// batches.h: the candidates of a light set in batches that are made and chosen among one after
// another, so that memory is that of one batch.
//
//   B = 2^b, the least with N/B <= 2^13      N: candidates, r (direct + 2 indirect)
//
// Each batch has N/B candidates, raw light and camera points of its own, and keeps N'/B of them.
// Each alone estimates all of the light; the set is their mean. Usual sets are one batch. A set of
// 320,000 candidates takes 20 MB so, and took 280 MB as a whole.
//
// Source:  Segovia et al. 2006, section 3.3 (resampling in batches).
// Proved:  tests/gi/batches_test.cpp.   Threads: plain values.   Errors: none.
#pragma once

#include <algorithm>

#include "common/scene/settings.h"

namespace ninefold {

struct Batch {
  int index = 0, log2Count = 0;

  int count() const { return 1 << log2Count; }
  // This batch's part of n; all parts add up to n.
  int partOf(int n) const { return endOf(n, index + 1) - endOf(n, index); }
  // m of indirect_vpls.h for the batch's light paths; -1 stays.
  int pathsLog2(int ofAll) const { return ofAll < 0 ? ofAll : std::max(ofAll - log2Count, 0); }
  // The frame's key with random numbers of this batch. Frames are fewer than 2^24, batches at most
  // 2^7.
  FrameKey keyOf(const FrameKey& frame) const {
    FrameKey key = frame;
    key.randomization += static_cast<uint32_t>(index) << 24;
    return key;
  }

 private:
  int endOf(int n, int batches) const {
    return static_cast<int>((int64_t{n} * batches) >> log2Count);
  }
};

inline int batchesLog2(const Settings& s) {
  constexpr int64_t kMost = 1 << 13;
  const int64_t candidates = s.resampling * (s.directVpls + 2 * int64_t{s.indirectVpls});
  int log2Count = 0;
  while (log2Count < 7 && candidates >> log2Count > kMost) ++log2Count;
  return log2Count;
}

}  // namespace ninefold
