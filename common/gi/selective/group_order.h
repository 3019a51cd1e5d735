// group_order.h: which rows of photons are traced next.
//
//   1. rows that were traced in another scene than the present one: pilots and groups by turns
//      pilots: the oldest first     groups: by V P, greatest first; among equals, the oldest
//   2. all others; among equals, the smaller number
//
// By turns, so that groups are not left for ever while each edit of a gesture calls for all pilots.
//
//   P   what changed paths of pilots that are like the group carry: added by steps, taken away
//       when the group is traced. What pilots of that same step add stays: in a gesture the next
//       edit mostly concerns the same groups.
//   V   share of such pilots that hit anything that the view shows; at least 1/16, so that what is
//       not seen comes at last, too
//
// Hits of pilots are in the state, so that V is known at once for any view. (As published it is
// counted anew after each move of the camera, and is 1 until enough pilots were traced.)
//
// Source:  Dmitriev et al. 2002, 5.2 and 5.3.   Proved: tests/gi/selective_test.cpp.
// Threads: rowOf from any thread; the order of one state is made once.   Errors: none.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "common/gi/elements/surface_numbers.h"
#include "common/gi/eye/task.h"
#include "common/gi/selective/group_pages.h"

namespace ninefold {

class GroupOrder {
 public:
  GroupOrder(const Tracer& tracer, const PhotonGroups& groups, const SurfaceNumbers& surfaces,
             uint64_t stamp)
      : tracer_(tracer), groups_(groups), rows_(groups), surfaces_(surfaces), stamp_(stamp) {}

  // That a unit of a step traces; the order is counted round. Where a step has units for all rows,
  // order means nothing. A unit has the same row in each such step: who traced it may have kept its
  // paths.
  uint32_t rowOf(const StatePages& pages, const View& view, const StepKey& step,
                 uint32_t unit) const;

 private:
  struct Urgency {
    int64_t priority;
    uint32_t version, row;
  };
  std::vector<uint32_t> orderOf(const StatePages& pages, const View& view) const;
  std::vector<int64_t> visibility(const StatePages& pages, const View& view) const;

  const Tracer& tracer_;
  const PhotonGroups& groups_;
  const GroupPages rows_;
  const SurfaceNumbers& surfaces_;
  const uint64_t stamp_;

  mutable std::mutex mutex_;
  mutable uint64_t key_ = 0;             // guarded by mutex_: of the order below
  mutable std::vector<uint32_t> order_;  // likewise
};

}  // namespace ninefold
