#include "client/method_states.h"

#include <algorithm>

namespace ninefold {

MethodStates::Shared MethodStates::get(uint32_t version, const StatePages& pages) {
  if (version == 0) return nullptr;
  const std::lock_guard lock(mutex_);
  const auto found = std::ranges::find(states_, pages.hash(), &std::pair<uint64_t, Shared>::first);
  if (found != states_.end()) return found->second;
  const Shared before = states_.empty() ? latest_->get() : states_.back().second;
  Shared made = digest_(pages, before.get());
  states_.emplace_back(pages.hash(), made);
  latest_->set(made);
  if (states_.size() > kKept) states_.pop_front();
  return made;
}

}  // namespace ninefold
