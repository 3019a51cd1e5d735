#include "common/gi/selective/group_pages.h"

namespace ninefold {

int64_t GroupPages::priority(const StatePages& pages, uint32_t group) {
  const Page* page = pages.find({0, static_cast<uint32_t>(group / kPageSums)});
  const auto* sums = page == nullptr ? nullptr : std::get_if<Sums>(page);
  return sums == nullptr ? 0 : (*sums)[group % kPageSums];
}

void GroupPages::addPriorities(const std::vector<int64_t>& amounts, PageDeltas& deltas) {
  for (size_t first = 0; first < amounts.size(); first += kPageSums) {
    std::vector<SumChange> changes;
    for (size_t g = first; g < std::min(first + kPageSums, amounts.size()); ++g)
      if (amounts[g] != 0) changes.push_back({static_cast<uint16_t>(g - first), amounts[g]});
    if (!changes.empty())
      deltas.push_back({{0, static_cast<uint32_t>(first / kPageSums)}, std::move(changes)});
  }
}

}  // namespace ninefold
