#include "common/gi/selective/kept_paths.h"

#include <utility>

namespace ninefold {

std::shared_ptr<const KeptRow> KeptPaths::find(uint32_t row, uint32_t randomization) const {
  const std::lock_guard lock(mutex_);
  for (const auto& kept : rows_[row])
    if (kept != nullptr && kept->randomization == randomization) return kept;
  return nullptr;
}

void KeptPaths::put(uint32_t row, std::shared_ptr<const KeptRow> kept) {
  const std::lock_guard lock(mutex_);
  auto& [latest, other] = rows_[row];
  if (latest != nullptr && latest->randomization != kept->randomization) other = std::move(latest);
  latest = std::move(kept);
}

}  // namespace ninefold
