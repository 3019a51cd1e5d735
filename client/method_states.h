// method_states.h: versions of a method's state, ready to be asked, that the worker threads of one
// client share.
//
// The first thread that needs a version digests its pages; others wait. The latest few are kept, by
// the pages' hash: another master may give other pages the same number. A scene after an edit has
// states of its own. The first one of them goes on from the latest of the client, whichever scene
// that is of: a job may be replaced before it has digested anything.
// Threads: get from any thread.   Errors: what `digest` throws reaches who asked.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>

#include "common/gi/method/method.h"

namespace ninefold {

// The latest state of one method, in whichever scene. Threads: any.
class LatestState {
 public:
  using Shared = std::shared_ptr<const MethodState>;

  void set(Shared state) {
    const std::lock_guard lock(mutex_);
    state_ = std::move(state);
  }
  Shared get() const {
    const std::lock_guard lock(mutex_);
    return state_;
  }

 private:
  mutable std::mutex mutex_;
  Shared state_;  // guarded by mutex_
};

class MethodStates {
 public:
  using Shared = LatestState::Shared;
  using Digest = std::function<Shared(const StatePages& pages, const MethodState* before)>;

  // `latest`: what all states of the method share; not null.
  MethodStates(Digest digest, std::shared_ptr<LatestState> latest)
      : digest_(std::move(digest)), latest_(std::move(latest)) {}

  // Null for version 0, the state of nothing.
  Shared get(uint32_t version, const StatePages& pages);

 private:
  static constexpr size_t kKept = 4;

  const Digest digest_;
  const std::shared_ptr<LatestState> latest_;
  std::mutex mutex_;
  std::deque<std::pair<uint64_t, Shared>> states_;  // guarded by mutex_; the latest last
};

}  // namespace ninefold
