#include "client/method_states.h"

namespace ninefold {

MethodStates::Shared MethodStates::get(uint32_t version, const StatePages& pages) {
  if (version == 0) return nullptr;
  const std::lock_guard lock(mutex_);
  if (const auto found = states_.find(version); found != states_.end()) return found->second;
  const MethodState* before = states_.empty() ? nullptr : states_.rbegin()->second.get();
  Shared made = digest_(pages, before);
  states_.emplace(version, made);
  if (states_.size() > kKept) states_.erase(states_.begin());
  return made;
}

}  // namespace ninefold
