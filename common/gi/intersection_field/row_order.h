// row_order.h: which rows of photons are traced next: those first that were traced in another scene
// than the present one, the oldest first; among equals, the smaller number.
// Threads: rowAt from any thread; the order of one state is made once.   Errors: none.
// Proved:  tests/gi/intersection_field_test.cpp.
#pragma once

#include <mutex>
#include <vector>

#include "common/gi/elements/photon_rows.h"

namespace ninefold {

class RowOrder {
 public:
  RowOrder(const PhotonRows& rows, uint64_t stamp) : rows_(rows), stamp_(stamp) {}

  // Number `rank` of the rows in their order, counted round.
  uint32_t rowAt(const StatePages& pages, uint32_t rank) const;

 private:
  std::vector<uint32_t> orderOf(const StatePages& pages) const;

  const PhotonRows rows_;
  const uint64_t stamp_;

  mutable std::mutex mutex_;
  mutable uint64_t key_ = 0;             // guarded by mutex_: hash of the state of the order below
  mutable std::vector<uint32_t> order_;  // likewise; empty: none yet
};

}  // namespace ninefold
