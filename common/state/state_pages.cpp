#include "common/state/state_pages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <span>

#include "common/base/error.h"
#include "common/sampling/hash.h"

namespace ninefold {
namespace {

uint64_t hashOf(std::span<const std::byte> bytes) {
  uint64_t hash = bytes.size();
  for (size_t at = 0; at < bytes.size(); at += sizeof(uint64_t)) {
    uint64_t word = 0;
    std::memcpy(&word, bytes.data() + at, std::min(sizeof word, bytes.size() - at));
    hash = hashWords(hash, word);
  }
  return hash;
}

// 0 for a page that says no more than one that is not there.
uint64_t hashOf(PageId id, const Page& page) {
  const bool isSums = std::holds_alternative<Sums>(page);
  if (isSums && std::ranges::count(std::get<Sums>(page), 0) == std::ssize(std::get<Sums>(page)))
    return 0;
  if (!isSums && std::get<Records>(page).empty()) return 0;
  const uint64_t content = isSums ? hashOf(std::as_bytes(std::span(std::get<Sums>(page))))
                                  : hashOf(std::get<Records>(page));
  return hashWords(id.kind, id.index, content, isSums);
}

std::string nameOf(PageId id) { return fmt::format("page {}.{}", id.kind, id.index); }

Page replaced(const PageDelta& delta, const Page* before) {
  const Records& records = std::get<Records>(delta.change);
  if (before != nullptr && !std::holds_alternative<Records>(*before))
    fail("{} of a method's state holds sums: it cannot be replaced", nameOf(delta.page));
  if (records.size() > kPageBytes)
    fail("{} of a method's state would have {} bytes; it may have {}", nameOf(delta.page),
         records.size(), kPageBytes);
  return records;
}

void add(Page& page, const PageDelta& delta) {
  if (!std::holds_alternative<Sums>(page))
    fail("{} of a method's state holds records: nothing can be added to it", nameOf(delta.page));
  Sums& sums = std::get<Sums>(page);
  for (const auto& [place, amount] : std::get<std::vector<SumChange>>(delta.change)) {
    if (place >= kPageSums) fail("{} of a method's state has no sum {}", nameOf(delta.page), place);
    if (__builtin_add_overflow(sums[place], amount, &sums[place]))
      fail("sum {} of {} of a method's state overflows", place, nameOf(delta.page));
  }
}

}  // namespace

StatePages::Changed StatePages::changedBy(std::span<const PageDeltas> all) const {
  Changed changed;
  for (const PageDeltas& deltas : all)
    for (const PageDelta& delta : deltas) {
      std::shared_ptr<Page>& page = changed[delta.page];
      const Page* before = page != nullptr ? page.get() : find(delta.page);
      if (std::holds_alternative<Records>(delta.change)) {
        page = std::make_shared<Page>(replaced(delta, before));
        continue;
      }
      if (page == nullptr)
        page = std::make_shared<Page>(before != nullptr ? *before : Sums(kPageSums, 0));
      add(*page, delta);
    }
  return changed;
}

void StatePages::take(Changed&& changed) {
  for (auto& [id, page] : changed) {
    Shared& mine = pages_[id];
    if (mine) hash_ -= hashOf(id, *mine);
    hash_ += hashOf(id, *page);
    mine = std::move(page);
  }
}

const Page* StatePages::find(PageId page) const {
  const auto found = pages_.find(page);
  return found == pages_.end() ? nullptr : found->second.get();
}

}  // namespace ninefold
