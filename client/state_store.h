// state_store.h: a client's copy of the method's state: the version that a late client was offered,
// fetched page by page, and those that deltas make of it since. Pure.
//
// Versions that share pages share their memory. Those that the master names no more are dropped.
//
// Proved:  tests/client/state_store_test.cpp.
// Threads: plain value, one owner; what find gives is constant.
// Errors:  all throw Error if the master says what cannot be: a page that is not what was offered,
//          a part that does not follow, a version whose hash is not the one that it should have.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "client/blob_fetch.h"
#include "common/state/state_pages.h"

namespace ninefold {

class StateStore {
 public:
  using Pages = std::shared_ptr<const StatePages>;

  void clear() { *this = {}; }
  void offer(msg::StateOffer&& offer);
  std::vector<msg::BlobRequest> requests() { return fetch_.requests(); }
  void chunk(msg::BlobChunk&& chunk);
  // All that was offered is there.
  bool isWhole() const { return !offered_; }
  void add(msg::StateDelta&& delta);

  // Version 0 is the empty state. Null: it is not there.
  Pages find(uint32_t version) const;

 private:
  struct Building {
    uint32_t version = 0;
    Pages from;
    std::vector<PageDeltas> parts = {};
  };
  void apply(const msg::StateDelta& delta);
  void keep(uint32_t version, uint64_t hash, StatePages&& pages);

  std::optional<msg::StateOffer> offered_;  // while pages of it are missing
  BlobFetch fetch_;
  StatePages fetched_;
  std::vector<msg::StateDelta> waiting_;  // for what was offered
  std::optional<Building> building_;
  std::map<uint32_t, Pages> versions_;
};

}  // namespace ninefold
