// group_pages.h: the state's pages: what the photons of each row hit, and how urgent groups are.
//
//   kind 0, sums      page g / 8192, place g mod 8192: priority P of group g, in 2^-32
//   kind 1, records   rows of photons (elements/photon_rows.h)
//
// Proved:  tests/gi/group_pages_test.cpp.
// Threads: pure functions.   Errors: as photon_rows.h.
#pragma once

#include <algorithm>
#include <vector>

#include "common/gi/elements/photon_rows.h"
#include "common/gi/selective/photon_groups.h"

namespace ninefold {

class GroupPages : public PhotonRows {
 public:
  explicit GroupPages(const PhotonGroups& groups)
      : PhotonRows(groups.rows(),
                   std::max(groups.photonsOf(0), groups.photonsOf(groups.groups()))) {}

  static int64_t priority(const StatePages& pages, uint32_t group);
  // amounts: by group; those that are 0 change nothing.
  static void addPriorities(const std::vector<int64_t>& amounts, PageDeltas& deltas);
};

}  // namespace ninefold
