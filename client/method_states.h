// method_states.h: versions of a method's state, ready to be asked, that the worker threads of one
// client share.
//
// The first thread that needs a version digests its pages; others wait. The latest few are kept, by
// the pages' hash: another master may give other pages the same number. A scene after an edit has
// states of its own, whose first one goes on from the last of those before.
// Threads: get from any thread.   Errors: what `digest` throws reaches who asked.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>

#include "common/gi/method/method.h"

namespace ninefold {

class MethodStates {
 public:
  using Shared = std::shared_ptr<const MethodState>;
  using Digest = std::function<Shared(const StatePages& pages, const MethodState* before)>;

  // `before`: the last state of the same method in another scene, or null.
  MethodStates(Digest digest, Shared before)
      : digest_(std::move(digest)), before_(std::move(before)) {}

  // Null for version 0, the state of nothing.
  Shared get(uint32_t version, const StatePages& pages);
  Shared latest();

 private:
  static constexpr size_t kKept = 4;

  const Digest digest_;  // constant after construction
  std::mutex mutex_;
  std::deque<std::pair<uint64_t, Shared>> states_;  // guarded by mutex_; the latest last
  Shared before_;                                   // likewise; null once there are states
};

}  // namespace ninefold
