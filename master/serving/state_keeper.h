// state_keeper.h: the master's copy of a method's state. It puts together what units of steps
// bring, makes versions of it, and gives clients what makes their copies the same. What pages mean
// it does not know. Pure.
//
//   open(step), take(unit) for each, complete(step): version step.to, and the messages that make it
//
// Versions are kept from the oldest one that an open frame or step names, and with each the
// messages that make it of the one before. A late client gets the oldest version whole and the
// messages since: then it can do whatever the others can.
//
// Proved:  tests/master/state_keeper_test.cpp.
// Threads: plain value, one owner.
// Errors:  take throws Error for a result that is malformed, was made of another state, or that the
//          state cannot take; complete if it cannot take all of them together (a sum overflows).
// Memory:  a state has at most kMaxStatePages pages.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "common/state/state_pages.h"
#include "proto/messages.h"
#include "proto/scene_blobs.h"

namespace ninefold {

class StateKeeper {
 public:
  // A version as pages, for a late client. Constant once made.
  struct Snapshot {
    msg::StateOffer offer;
    std::map<Sha256, Blob> blobs;
  };

  // Before the first step: a version that another run has made.
  void resume(uint32_t version, StatePages pages);
  void open(const StepKey& step);
  // Open steps before `firstWanted` are void.
  void drop(uint32_t firstWanted);
  // Of an open step; each unit once.
  void take(msg::Stepped&& result);
  // All units of it are there. The messages hold until the next change.
  const std::vector<msg::StateDelta>& complete(uint32_t number);
  // No version before `oldest` is named any more.
  void forget(uint32_t oldest);

  const StatePages& latest() const { return pagesOf(version()); }
  const StatePages& pagesOf(uint32_t version) const;  // of one that is kept
  uint32_t version() const { return versions_.empty() ? 0 : versions_.rbegin()->first; }
  // The oldest version; null if that is the empty one.
  std::shared_ptr<const Snapshot> snapshot();
  // What makes the latest version of it, in order.
  std::vector<msg::StateDelta> since() const;

 private:
  struct Step {
    StepKey key;
    std::map<uint32_t, std::pair<PageDeltas, Bytes>> results;  // by unit; as pages, as they came
  };
  struct Version {
    StatePages pages;
    std::vector<msg::StateDelta> messages;  // that make it of another
  };

  std::map<uint32_t, Step> open_;         // by number
  std::map<uint32_t, Version> versions_;  // the latest, and those that are named
  uint32_t oldest_ = 0;
  std::shared_ptr<const Snapshot> snapshot_;  // of oldest_, once somebody asked
};

}  // namespace ninefold
