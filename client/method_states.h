// method_states.h: versions of a method's state, ready to be asked, that the worker threads of one
// client share.
//
// The first thread that needs a version digests its pages; others wait. The latest few are kept.
// Threads: get from any thread.   Errors: what `digest` throws reaches who asked.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>

#include "common/gi/method/method.h"

namespace ninefold {

class MethodStates {
 public:
  using Shared = std::shared_ptr<const MethodState>;
  using Digest = std::function<Shared(const StatePages& pages, const MethodState* before)>;

  explicit MethodStates(Digest digest) : digest_(std::move(digest)) {}

  // Null for version 0.
  Shared get(uint32_t version, const StatePages& pages);

 private:
  static constexpr size_t kKept = 4;

  const Digest digest_;  // constant after construction
  std::mutex mutex_;
  std::map<uint32_t, Shared> states_;  // guarded by mutex_
};

}  // namespace ninefold
