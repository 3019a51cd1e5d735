// state_pages.h: the pages of one version of a method's state.
//
// A copy shares its pages with the original, and a change copies what it changes alone. So many
// versions can be kept, for as much memory as they differ.
//
// Cost:    O(log pages) to find one; to apply, a copy and a hash of each changed page, once for all
//          deltas that are applied together.
// Proved:  tests/state/state_pages_test.cpp.
// Threads: a value; copies may be used by different threads.
// Errors:  apply throws Error, and changes nothing, if a sum overflows or leaves its page, if a
//          page grows beyond kPageBytes, or if it changes its form.
#pragma once

#include <map>
#include <memory>
#include <span>

#include "common/state/page.h"

namespace ninefold {

class StatePages {
 public:
  using Shared = std::shared_ptr<const Page>;

  void apply(const PageDeltas& deltas) { take(changedBy({&deltas, 1})); }
  // All of them, one after another.
  void applyAll(std::span<const PageDeltas> all) { take(changedBy(all)); }
  // Throws what apply would throw.
  void check(const PageDeltas& deltas) const { changedBy({&deltas, 1}); }

  // Null: nobody has written it.
  const Page* find(PageId page) const;
  const std::map<PageId, Shared>& all() const { return pages_; }

  // Of all pages; equal for equal states, whatever led to them.
  uint64_t hash() const { return hash_; }

 private:
  using Changed = std::map<PageId, std::shared_ptr<Page>>;
  Changed changedBy(std::span<const PageDeltas> all) const;
  void take(Changed&& changed);

  std::map<PageId, Shared> pages_;
  uint64_t hash_ = 0;  // sum of the pages' own, so that the order of changes does not count
};

}  // namespace ninefold
